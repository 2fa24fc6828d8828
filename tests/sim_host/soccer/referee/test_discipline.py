"""Cards and people: who leaves the field, for how long, and who comes back when."""

import pytest

from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import Card, EventKind, OffField, Phase, Score
from sim_host.soccer.referee.game.participation import CardCount, Participation
from sim_host.soccer.referee.procedures.discipline import for_next_half

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def away(rig, name):
    return rig.state.participation.absences.get(name)


def is_beside(rig, name):
    return abs(rig.robots[name][1]) > rig.pitch.touch_line + rig.pitch.border


def refused(ruling):
    (reply,) = ruling.replies
    assert not reply.accepted
    return reply.reason


def halted(rig):
    """Play is stopped by people."""
    rig.playing()
    rig.ask("stop")
    return rig


@pytest.mark.parametrize("name", ["cyan1", "cyan5", "magenta1", "magenta4"])
def test_two_yellow_cards_suspend_and_the_third_is_red_for_whichever_robot(rig, name):
    """simatch's referee can send off robots 2 to 5 only."""
    halted(rig)
    rig.ask("yellow_card", robot=name)
    assert away(rig, name) is None and not is_beside(rig, name)
    rig.ask("yellow_card", robot=name)
    assert away(rig, name) == (OffField.SECOND_YELLOW, rig.book.discipline.suspension) and is_beside(rig, name)
    rig.ask("yellow_card", robot=name)
    assert away(rig, name) == (OffField.RED_CARD, None)
    assert "for good" in refused(rig.ask("yellow_card", robot=name))
    cards = [event.card for event in rig.events if event.kind is EventKind.CARD]
    assert cards == [Card.YELLOW, Card.YELLOW, Card.RED]


def test_a_suspension_is_served_in_playing_time_and_ends_at_the_next_stoppage(rig):
    rig.playing()
    for _ in range(2):
        rig.ask("yellow_card", robot="cyan3")
    rig.velocity = (1.0, 0.0, 0.0)
    rig.play_on(rig.book.discipline.suspension + 1.0)
    assert away(rig, "cyan3").left == 0.0 and is_beside(rig, "cyan3")
    assert "stoppage" in refused(rig.ask("enter", robot="cyan3"))
    rig.ask("stop")
    assert away(rig, "cyan3") is None and not is_beside(rig, "cyan3")
    assert rig.events[-1].kind is EventKind.ON_FIELD and rig.events[-1].robot == "cyan3"


def test_a_suspension_waits_from_stop_to_start_and_a_repair_does_not(rig):
    """The league's box counts so; ours counted with the game clock, which runs on, 10 s fast after one stop."""
    halted(rig)
    for _ in range(2):
        rig.ask("yellow_card", robot="cyan3")
    rig.ask("repair", robot="cyan4")
    rig.run(5.0)
    assert away(rig, "cyan3").left == rig.book.discipline.suspension
    assert away(rig, "cyan4").left == pytest.approx(rig.book.people.repair - 5.0)


def test_a_red_card_is_for_good_and_the_robot_is_beside_the_field_in_both_halves(rig):
    halted(rig)
    rig.ask("red_card", robot="magenta1")
    assert "for good" in refused(rig.ask("enter", robot="magenta1"))
    rig.ask("end_half")
    rig.until(lambda state: state.half == 2)
    rig.run(3.0)
    assert away(rig, "magenta1").for_good and is_beside(rig, "magenta1")
    assert rig.state.game_state(1, 0.0).robots["magenta1"].off_field is OffField.RED_CARD


def test_in_the_simulation_league_reds_last_longer_each_time_and_the_fifth_is_for_good(new_rig):
    """China simulation league 2020: 30 s, 5 s more for each later one of a side; every five reds one robot for good."""
    rig = halted(new_rig(rules="china-sim-2020"))
    durations = []
    for name in ("cyan1", "cyan2", "cyan3", "cyan4", "cyan5"):
        rig.ask("red_card", robot=name)
        durations.append(away(rig, name).left)
    rig.ask("red_card", robot="magenta2")
    assert durations == [30.0, 35.0, 40.0, 45.0, None] and away(rig, "magenta2").left == 30.0


def test_in_the_simulation_league_three_yellows_are_a_red(new_rig):
    rig = halted(new_rig(rules="china-sim-2020"))
    for _ in range(2):
        rig.ask("yellow_card", robot="cyan2")
    assert away(rig, "cyan2") is None
    rig.ask("yellow_card", robot="cyan2")
    assert away(rig, "cyan2").why is OffField.RED_CARD


def test_at_half_time_yellow_cards_are_forgotten_and_red_cards_are_not(new_rig):
    before = Participation(cards={"cyan2": CardCount(yellow=1, red=2)})
    for rules, yellow in (("china-sim-2020", 0), ("msl", 1)):
        after = for_next_half(before, new_rig(rules=rules).book.discipline)
        assert after.cards == {"cyan2": CardCount(yellow, red=2)}


def test_in_the_simulation_league_one_robot_of_a_side_comes_back_in_a_stoppage(new_rig):
    rig = new_rig(rules="china-sim-2020")
    rig.playing()
    for name in ("cyan3", "cyan4", "magenta3"):
        rig.ask("repair", robot=name)
    rig.velocity = (1.0, 0.0, 0.0)
    rig.run(rig.book.people.repair)
    rig.ask("stop")
    rig.run(1.0)
    assert set(rig.state.participation.absences) == {"cyan4"}
    assert "limit" in refused(rig.ask("enter", robot="cyan4"))
    rig.ask("start")
    rig.until(lambda state: state.running)
    rig.ask("stop")
    assert rig.state.participation.absences == {}


def test_a_robot_in_repair_comes_back_by_itself_after_its_time_and_not_before(rig):
    halted(rig)
    rig.ask("repair", robot="cyan3")
    out = rig.events[-1].time
    assert "s left" in refused(rig.ask("enter", robot="cyan3"))
    rig.until(lambda state: "cyan3" not in state.participation.absences)
    assert rig.events[-1].time - out == pytest.approx(rig.book.people.repair, abs=2 * rig.dt)


def test_so_many_robots_of_a_side_are_in_repair_at_once(rig):
    halted(rig)
    for name in ("cyan2", "cyan3", "cyan4"):
        assert rig.ask("repair", robot=name).replies[0].accepted
    assert "limit" in refused(rig.ask("repair", robot="cyan5"))
    assert rig.ask("repair", robot="magenta5").replies[0].accepted
    assert "already" in refused(rig.ask("repair", robot="cyan2"))


def test_the_last_robot_of_a_side_on_the_field_is_not_repaired(new_rig):
    rig = halted(new_rig(size=3))
    for name in ("cyan1", "cyan2"):
        assert rig.ask("repair", robot=name).replies[0].accepted
    assert "cyan3 is the last robot of cyan on the field" in refused(rig.ask("repair", robot="cyan3"))
    assert rig.ask("repair", robot="magenta2").replies[0].accepted


def test_substitutions_are_counted_and_made_in_stoppages(new_rig):
    rig = new_rig()
    rig.playing()
    assert "running" in refused(rig.ask("substitute", robot="cyan2"))
    rig.ask("stop")
    for name in ("cyan2", "cyan3", "cyan4"):
        assert rig.ask("substitute", robot=name).replies[0].accepted
    assert "cyan2 is being substituted already" in refused(rig.ask("substitute", robot="cyan2"))
    assert "3 are allowed" in refused(rig.ask("substitute", robot="cyan5"))
    rig.run(rig.book.people.substitution + 1.0)
    assert rig.state.participation.absences == {}


def test_a_suspended_robot_is_not_substituted(new_rig):
    rig = halted(new_rig())
    for _ in range(2):
        rig.ask("yellow_card", robot="cyan2")
    left = rig.book.discipline.suspension
    assert f"cyan2 is off the field for {left:.0f} s more: suspension" in refused(rig.ask("substitute", robot="cyan2"))
    assert away(rig, "cyan2").why is OffField.SECOND_YELLOW
    assert away(rig, "cyan2").left == pytest.approx(left, abs=0.1)
    rig.ask("start")
    rig.play_on(left + 10.0)
    rig.ask("stop")
    assert rig.ask("substitute", robot="cyan2").replies[0].accepted


def test_another_card_does_not_shorten_a_suspension(new_rig):
    rig = halted(new_rig(rules="friendly"))
    rig.ask("red_card", robot="cyan2")
    assert away(rig, "cyan2").left > rig.book.discipline.suspension + 1.0
    rig.ask("double_yellow", robot="cyan2")
    assert away(rig, "cyan2").why is OffField.SECOND_YELLOW
    assert away(rig, "cyan2").left > rig.book.discipline.suspension + 1.0


@pytest.mark.parametrize("name", ["yellow_card", "red_card", "double_yellow", "repair", "substitute", "park", "enter"])
def test_a_side_that_is_not_the_robots_is_refused(rig, name):
    halted(rig)
    words = f"{name}: magenta1 does not play for cyan, which is named; leave the side out"
    assert refused(rig.ask(name, CYAN, robot="magenta1")) == words
    assert "does not play" not in rig.ask(name, MAGENTA, robot="magenta1").replies[0].reason


def test_in_2016_no_robot_is_substituted(new_rig):
    assert "0 are allowed" in refused(halted(new_rig("paper")).ask("substitute", robot="cyan2"))


def test_a_parked_robot_waits_for_the_action_enter(rig):
    halted(rig)
    rig.ask("park", robot="magenta5")
    rig.run(60.0)
    assert away(rig, "magenta5").why is OffField.PARKED and is_beside(rig, "magenta5")
    rig.ask("enter", robot="magenta5")
    assert not is_beside(rig, "magenta5")
    assert "on the field" in refused(rig.ask("enter", robot="magenta5"))


def test_nobody_is_taken_out_for_silence_before_the_game_begins(new_rig):
    """Programs may join for as long as people have not called the kick-off."""
    rig = new_rig(automatic=False)
    assert rig.state.phase is Phase.PRE_GAME
    for _ in range(round((rig.book.people.silent_limit + 1.0) / rig.dt)):
        rig.tick(silent=["cyan4"])
    assert "cyan4" not in rig.state.participation.absences
    rig.tick(actions=[RefereeAction(action="kick_off", side=CYAN)], silent=["cyan4"])
    rig.tick(silent=["cyan4"])
    assert away(rig, "cyan4").why is OffField.SILENT


def test_robots_that_may_return_at_once_come_back_one_in_a_tick(rig):
    """The next snapshot shows where one is, and where there is room for another."""
    halted(rig)
    for name in ("cyan2", "cyan3"):
        rig.ask("repair", robot=name)
    back = [
        [event.robot for event in ruling.events if event.kind is EventKind.ON_FIELD]
        for ruling in rig.run(rig.book.people.repair + 1.0)
    ]
    assert [robots for robots in back if robots] == [["cyan2"], ["cyan3"]]


@pytest.mark.parametrize(("seconds", "is_out"), [(9.9, False), (10.1, True)])
def test_a_robot_whose_program_is_gone_is_taken_out_and_comes_back_with_it(rig, seconds, is_out):
    rig.playing()
    for _ in range(round(seconds / rig.dt)):
        rig.tick(silent=["cyan4"])
    assert (away(rig, "cyan4") is not None) == is_out
    if not is_out:
        return
    assert away(rig, "cyan4").why is OffField.SILENT
    rig.tick(actions=[RefereeAction(action="stop")], silent=["cyan4"])
    for _ in range(50):
        rig.tick(silent=["cyan4"])
    assert away(rig, "cyan4") is not None
    rig.run(0.1)
    assert away(rig, "cyan4") is None


def test_a_program_that_answers_again_begins_its_silence_anew(rig):
    rig.playing()
    for _ in range(3):
        for _ in range(round(6.0 / rig.dt)):
            rig.tick(silent=["cyan4"])
        rig.tick()
    assert rig.state.participation.absences == {}


@pytest.mark.parametrize(("sent_off", "forfeits"), [(3, False), (4, True)])
def test_a_side_that_cannot_field_two_robots_forfeits_by_three_goals(rig, sent_off, forfeits):
    halted(rig)
    for number in range(1, sent_off + 1):
        rig.ask("red_card", robot=f"cyan{number}")
    assert (rig.state.phase is Phase.FULL_TIME) == forfeits
    if forfeits:
        assert rig.state.score == Score(magenta=3)
        event = next(event for event in rig.events if event.kind is EventKind.FORFEIT)
        assert (event.side, event.measured, event.limit) == (CYAN, 1, 2)


@pytest.mark.parametrize(("goals", "score"), [((1, 0), (0, 3)), ((5, 1), (0, 3)), ((1, 2), (0, 3)), ((1, 5), (1, 5))])
def test_a_forfeit_is_three_to_none_or_a_greater_lead_of_the_winner(rig, goals, score):
    rig.playing()
    for side, count in zip(Side, goals, strict=True):
        for _ in range(count):
            rig.ask("goal", side)
    for number in range(1, 5):
        rig.ask("red_card", robot=f"cyan{number}")
    assert rig.state.score == Score(cyan=score[0], magenta=score[1])


def test_where_both_sides_have_as_few_robots_left_neither_wins(rig):
    """The first robots of the roster have no advantage."""
    rig.playing()
    gone = [f"{side.value}{number}" for side in Side for number in range(2, 6)]
    for _ in range(round((rig.book.people.silent_limit + 1.0) / rig.dt)):
        rig.tick(silent=gone)
    assert rig.state.phase is Phase.FULL_TIME
    assert rig.state.score == Score()
    assert rig.events[-1].text == "full time, neither side can field 2 robots"


def test_robots_that_will_be_back_are_no_forfeit(rig):
    halted(rig)
    for number in range(2, 5):
        rig.ask("repair", robot=f"cyan{number}")
    rig.ask("park", robot="cyan5")
    rig.run(1.0)
    assert rig.state.phase is Phase.STOPPED


@pytest.mark.parametrize("name", ["yellow_card", "red_card", "repair", "substitute", "park", "enter"])
def test_what_is_for_a_robot_needs_one_that_plays_and_a_match(new_rig, name):
    rig = new_rig(automatic=False)
    assert "pre_game" in refused(rig.ask(name, robot="cyan2"))
    halted_bench = halted(new_rig())
    assert "no robot is named" in refused(halted_bench.ask(name))
    assert "zebra9" in refused(halted_bench.ask(name, robot="zebra9"))


def test_robots_off_the_field_block_no_robot_before_a_restart(rig):
    """Their kicker is another, and they are not looked at for their distance."""
    rig.playing()
    rig.ask("park", robot="cyan2")
    rig.robots["cyan2"] = (2.2, 1.0)
    rig.ask("free_kick", MAGENTA, (2.0, 1.0))
    signalled = rig.until(lambda state: state.phase is Phase.FREE_KICK).events[-1].time
    rig.until(lambda state: state.running)
    assert rig.events[-1].time - signalled == pytest.approx(rig.book.restarts.signal_to_start)
