"""Cards and people: who leaves the field, for how long, and who comes back when (reference 9.3, 10.3, 10.6)."""

import pytest

from schemas.game import Card, EventKind, OffField, Phase, RefereeAction, Score
from schemas.side import Side
from sim_host.referee.decision import Decision
from sim_host.referee.flow import carry_out
from sim_host.referee.turn import Turn

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def away(bench, name):
    return bench.state.people.away.get(name)


def is_beside(bench, name):
    return abs(bench.robots[name][1]) > bench.pitch.touch_line + bench.pitch.border


def refused(ruling):
    (reply,) = ruling.replies
    assert not reply.accepted
    return reply.reason


def halted(bench):
    """Play is stopped by people."""
    bench.playing()
    bench.ask("stop")
    return bench


@pytest.mark.parametrize("name", ["cyan1", "cyan5", "magenta1", "magenta4"])
def test_two_yellow_cards_suspend_and_the_third_is_red_for_whichever_robot(bench, name):
    """Reference 14, defect 13: only robots 2 to 5 could be sent off."""
    halted(bench)
    bench.ask("yellow_card", robot=name)
    assert away(bench, name) is None and not is_beside(bench, name)
    bench.ask("yellow_card", robot=name)
    assert away(bench, name) == (OffField.SECOND_YELLOW, bench.book.discipline.suspension) and is_beside(bench, name)
    bench.ask("yellow_card", robot=name)
    assert away(bench, name) == (OffField.RED_CARD, None)
    assert "for good" in refused(bench.ask("yellow_card", robot=name))
    cards = [event.card for event in bench.events if event.kind is EventKind.CARD]
    assert cards == [Card.YELLOW, Card.YELLOW, Card.RED]


def test_a_suspension_is_served_in_playing_time_and_ends_at_the_next_stoppage(bench):
    bench.playing()
    for _ in range(2):
        bench.ask("yellow_card", robot="cyan3")
    bench.velocity = (1.0, 0.0, 0.0)
    bench.run(bench.book.discipline.suspension + 1.0)
    assert away(bench, "cyan3").left == 0.0 and is_beside(bench, "cyan3")
    assert "stoppage" in refused(bench.ask("enter", robot="cyan3"))
    bench.ask("stop")
    assert away(bench, "cyan3") is None and not is_beside(bench, "cyan3")
    assert bench.events[-1].kind is EventKind.ON_FIELD and bench.events[-1].robot == "cyan3"


def test_a_suspension_waits_while_the_clock_stands_and_a_repair_does_not(new_bench):
    bench = new_bench(duration=20.0)
    halted(bench)
    bench.ask("end_half")
    for _ in range(2):
        bench.ask("yellow_card", robot="cyan3")
    bench.ask("repair", robot="cyan4")
    bench.run(5.0)
    assert away(bench, "cyan3").left == bench.book.discipline.suspension
    assert away(bench, "cyan4").left == pytest.approx(bench.book.people.repair - 5.0)


def test_a_red_card_is_for_good_and_the_robot_is_beside_the_field_in_both_halves(bench):
    halted(bench)
    bench.ask("red_card", robot="magenta1")
    assert "for good" in refused(bench.ask("enter", robot="magenta1"))
    bench.ask("end_half")
    bench.until(lambda state: state.half == 2)
    bench.run(3.0)
    assert away(bench, "magenta1").for_good and is_beside(bench, "magenta1")
    assert bench.state.game_state(1, 0.0).robots["magenta1"].off_field is OffField.RED_CARD


def test_in_the_simulation_league_reds_last_longer_each_time_and_the_fifth_is_for_good(new_bench):
    """Reference 10.6: 30 s, 5 s more for each later one of the side; every five reds one robot for good."""
    bench = halted(new_bench(rules="china-sim-2020"))
    durations = []
    for name in ("cyan1", "cyan2", "cyan3", "cyan4", "cyan5"):
        bench.ask("red_card", robot=name)
        durations.append(away(bench, name).left)
    bench.ask("red_card", robot="magenta2")
    assert durations == [30.0, 35.0, 40.0, 45.0, None] and away(bench, "magenta2").left == 30.0


def test_in_the_simulation_league_three_yellows_are_a_red_and_are_forgotten_at_half_time(new_bench):
    bench = halted(new_bench(rules="china-sim-2020"))
    for _ in range(2):
        bench.ask("yellow_card", robot="cyan2")
    assert away(bench, "cyan2") is None
    bench.ask("yellow_card", robot="cyan3")
    bench.ask("yellow_card", robot="cyan2")
    assert away(bench, "cyan2").why is OffField.RED_CARD
    bench.ask("end_half")
    bench.until(lambda state: state.half == 2)
    assert bench.state.people.records["cyan3"].yellow == 0


def test_in_the_simulation_league_one_robot_of_a_side_comes_back_in_a_stoppage(new_bench):
    bench = new_bench(rules="china-sim-2020")
    bench.playing()
    for name in ("cyan3", "cyan4", "magenta3"):
        bench.ask("repair", robot=name)
    bench.velocity = (1.0, 0.0, 0.0)
    bench.run(bench.book.people.repair)
    bench.ask("stop")
    bench.run(1.0)
    assert set(bench.state.people.away) == {"cyan4"}
    assert "limit" in refused(bench.ask("enter", robot="cyan4"))
    bench.ask("start")
    bench.until(lambda state: state.running)
    bench.ask("stop")
    assert bench.state.people.away == {}


def test_a_robot_in_repair_comes_back_by_itself_after_its_time_and_not_before(bench):
    halted(bench)
    bench.ask("repair", robot="cyan3")
    out = bench.events[-1].time
    assert "s are left" in refused(bench.ask("enter", robot="cyan3"))
    bench.until(lambda state: "cyan3" not in state.people.away)
    assert bench.events[-1].time - out == pytest.approx(bench.book.people.repair, abs=2 * bench.dt)


def test_so_many_robots_of_a_side_are_in_repair_at_once(bench):
    halted(bench)
    for name in ("cyan2", "cyan3", "cyan4"):
        assert bench.ask("repair", robot=name).replies[0].accepted
    assert "limit" in refused(bench.ask("repair", robot="cyan5"))
    assert bench.ask("repair", robot="magenta5").replies[0].accepted
    assert "already" in refused(bench.ask("repair", robot="cyan2"))


def test_substitutions_are_counted_and_made_in_stoppages(new_bench):
    bench = new_bench()
    bench.playing()
    assert "running" in refused(bench.ask("substitute", robot="cyan2"))
    bench.ask("stop")
    for name in ("cyan2", "cyan3", "cyan4"):
        assert bench.ask("substitute", robot=name).replies[0].accepted
    assert "3 are allowed" in refused(bench.ask("substitute", robot="cyan5"))
    bench.run(bench.book.people.substitution + 1.0)
    assert bench.state.people.away == {}


def test_in_2016_nobody_is_substituted(new_bench):
    assert "0 are allowed" in refused(halted(new_bench("paper")).ask("substitute", robot="cyan2"))


def test_a_parked_robot_waits_until_it_is_told_to_enter(bench):
    halted(bench)
    bench.ask("park", robot="magenta5")
    bench.run(60.0)
    assert away(bench, "magenta5").why is OffField.PARKED and is_beside(bench, "magenta5")
    bench.ask("enter", robot="magenta5")
    assert not is_beside(bench, "magenta5")
    assert "on the field" in refused(bench.ask("enter", robot="magenta5"))


def test_robots_come_back_each_in_a_place_of_its_own_in_their_own_half(bench):
    halted(bench)
    names = ("cyan2", "cyan3", "cyan4")
    for name in names:
        bench.ask("repair", robot=name)
    bench.run(bench.book.people.repair + 1.0)
    places = [bench.robots[name] for name in names]
    assert all(-bench.pitch.goal_line < x < 0.0 and abs(y) < bench.pitch.touch_line for x, y in places)
    assert len({round(x, 2) for x, _ in places}) == 3


@pytest.mark.parametrize(("seconds", "is_out"), [(9.9, False), (10.1, True)])
def test_a_robot_whose_program_is_gone_is_taken_out_and_comes_back_with_it(bench, seconds, is_out):
    bench.playing()
    for _ in range(round(seconds / bench.dt)):
        bench.tick(silent=["cyan4"])
    assert (away(bench, "cyan4") is not None) == is_out
    if not is_out:
        return
    assert away(bench, "cyan4").why is OffField.SILENT
    bench.tick(actions=[RefereeAction(action="stop")], silent=["cyan4"])
    for _ in range(50):
        bench.tick(silent=["cyan4"])
    assert away(bench, "cyan4") is not None
    bench.run(0.1)
    assert away(bench, "cyan4") is None


def test_a_program_that_answers_again_begins_its_silence_anew(bench):
    bench.playing()
    for _ in range(3):
        for _ in range(round(6.0 / bench.dt)):
            bench.tick(silent=["cyan4"])
        bench.tick()
    assert bench.state.people.away == {}


@pytest.mark.parametrize(("sent_off", "forfeits"), [(3, False), (4, True)])
def test_a_side_that_cannot_field_two_robots_forfeits_by_three_goals(bench, sent_off, forfeits):
    halted(bench)
    for number in range(1, sent_off + 1):
        bench.ask("red_card", robot=f"cyan{number}")
    assert (bench.state.phase is Phase.FULL_TIME) == forfeits
    if forfeits:
        assert bench.state.score == Score(magenta=3)
        event = next(event for event in bench.events if event.kind is EventKind.FORFEIT)
        assert (event.side, event.measured, event.limit) == (CYAN, 1, 2)


def test_a_forfeit_takes_nothing_from_a_greater_lead_and_turns_a_deficit_round(bench):
    bench.playing()
    bench.ask("goal", CYAN)
    for number in range(1, 5):
        bench.ask("red_card", robot=f"cyan{number}")
    assert bench.state.score == Score(cyan=1, magenta=4)


def test_where_both_sides_have_as_few_robots_left_neither_wins(bench):
    """Nobody is favoured by coming first in the roster."""
    bench.playing()
    gone = [f"{side.value}{number}" for side in Side for number in range(2, 6)]
    for _ in range(round((bench.book.people.silent_limit + 1.0) / bench.dt)):
        bench.tick(silent=gone)
    assert bench.state.phase is Phase.FULL_TIME
    assert bench.state.score == Score()
    assert bench.events[-1].text == "full time, neither side can field 2 robots"


def test_robots_that_will_be_back_are_no_forfeit(bench):
    halted(bench)
    for number in range(2, 5):
        bench.ask("repair", robot=f"cyan{number}")
    bench.ask("park", robot="cyan5")
    bench.run(1.0)
    assert bench.state.phase is Phase.STOPPED


@pytest.mark.parametrize("name", ["yellow_card", "red_card", "repair", "substitute", "park", "enter"])
def test_what_is_for_a_robot_needs_one_that_plays_and_a_match(new_bench, name):
    bench = new_bench(automatic=False)
    assert "pre_game" in refused(bench.ask(name, robot="cyan2"))
    halted_bench = halted(new_bench())
    assert "no robot is named" in refused(halted_bench.ask(name))
    assert "zebra9" in refused(halted_bench.ask(name, robot="zebra9"))


def test_the_card_of_a_decision_is_shown_by_its_rule(bench):
    bench.playing()
    turn = Turn(bench.referee._match, bench.snapshot(), bench.state)
    text = "cyan3 dribbled 3.21 m, limit 3.00"
    foul = Decision(EventKind.FOUL, text, robot="cyan3", measured=3.21, limit=3.0, unit="m", card=Card.YELLOW)
    carry_out(turn, "dribble", foul)
    assert [(event.kind, event.rule) for event in turn.events[:2]] == [
        (EventKind.FOUL, "dribble"),
        (EventKind.CARD, "dribble"),
    ]
    assert (turn.events[0].measured, turn.events[0].limit, turn.events[0].unit) == (3.21, 3.0, "m")
    assert turn.state.people.records["cyan3"].yellow == 1


def test_robots_off_the_field_stand_in_nobodys_way_before_a_restart(bench):
    """Their kicker is another, and they are not looked at for their distance."""
    bench.playing()
    bench.ask("park", robot="cyan2")
    bench.robots["cyan2"] = (2.2, 1.0)
    bench.ask("free_kick", MAGENTA, (2.0, 1.0))
    signalled = bench.until(lambda state: state.phase is Phase.FREE_KICK).events[-1].time
    bench.until(lambda state: state.running)
    assert bench.events[-1].time - signalled == pytest.approx(bench.book.restarts.signal_to_start)
