"""Advantage: play goes on after a foul, as long as the side that suffered it keeps the ball."""

import pytest

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, OfficiatingMode, Phase, Score
from sim_host.soccer.referee.game.state_json import state_from_json, state_json

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
BALL = (1.0, 1.0)
FOUL_SPEED = 2.0


def fouled(rig, holder="cyan3", speed=FOUL_SPEED, x=0.0, mover="magenta2", victim="cyan4"):
    """A side holds the ball, and an opponent drives into another robot of it."""
    rig.playing(BALL)
    rig.robots |= {"cyan3": (0.7, 1.0), "cyan5": (2.0, 1.0), victim: (x, -3.0), mover: (x + 0.5, -3.0)}
    rig.tick(BALL, [holder], possession=holder)
    rig.events.clear()
    rig.tick(BALL, [holder], possession=holder, impacts=[(victim, mover)], motions={mover: (0.0, -speed, 0.0)})
    return rig


def new(new_rig, seconds=3.0, **options):
    return new_rig(advantage=seconds, **options)


def hold(rig, robot, seconds):
    for _ in range(round(seconds / rig.dt)):
        rig.tick(touches=[robot], possession=robot)


def kinds(rig, *wanted):
    return [event.kind for event in rig.events if event.kind in wanted]


FOUL, ADVANTAGE, CARD, STOP = EventKind.FOUL, EventKind.ADVANTAGE, EventKind.CARD, EventKind.STOP


@pytest.mark.parametrize("mirrored", [False, True])
def test_play_goes_on_after_a_foul_on_the_side_that_has_the_ball(new_rig, mirrored):
    rig = fouled(new(new_rig, mirrored=mirrored))
    (event,) = rig.events
    assert (event.kind, event.rule, event.robot) == (ADVANTAGE, "charging", rig.robot("magenta2"))
    assert f"advantage for {rig.side(CYAN)}, 3 s" in event.text and "no advantage" not in event.text
    assert (event.measured, event.limit, event.unit) == (pytest.approx(FOUL_SPEED), 1.5, "m/s")
    assert rig.state.phase is Phase.PLAY and rig.state.running


def test_a_side_that_loses_the_ball_in_time_gets_the_restart_where_the_foul_was(new_rig):
    rig = fouled(new(new_rig))
    hold(rig, "cyan3", 1.0)
    rig.tick((4.0, 2.0), ["magenta3"], possession="magenta3")
    foul = next(event for event in rig.events if event.kind is FOUL)
    assert (foul.rule, foul.robot) == ("charging", "magenta2")
    assert "cyan lost its advantage after 1.0 s" in foul.text
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.FREE_KICK, CYAN)
    assert rig.state.pending.spot == pytest.approx(BALL)
    assert rig.state.advantage is None


@pytest.mark.parametrize(("kept", "foul"), [(2.9, True), (3.1, False)])
def test_an_advantage_lapses_after_its_seconds(new_rig, kept, foul):
    rig = fouled(new(new_rig))
    hold(rig, "cyan3", kept)
    rig.tick((4.0, 2.0), ["magenta3"], possession="magenta3")
    assert (FOUL in rig.kinds()) is foul
    if not foul:
        assert kinds(rig, ADVANTAGE) == [ADVANTAGE, ADVANTAGE] and rig.state.running
        assert "cyan has used its advantage" in rig.events[1].text


def test_a_pass_keeps_the_advantage_and_a_ball_that_grazes_an_opponent_does_not_lose_it(new_rig):
    rig = fouled(new(new_rig))
    rig.tick((2.0, 1.0), ["cyan3"], kicked="cyan3")
    rig.tick((3.0, 1.0), ["magenta4"])
    rig.tick((4.0, 1.0), ["cyan5"], possession="cyan5")
    assert rig.state.advantage is not None and rig.state.running


def test_without_seconds_the_game_stops_at_once(new_rig):
    rig = fouled(new_rig())
    assert kinds(rig, FOUL, ADVANTAGE, STOP) == [FOUL, STOP]
    assert "no advantage is played" in rig.events[0].text


def test_the_match_file_overrides_the_rule_book(new_rig):
    assert new_rig().book.restarts.advantage == 0.0
    assert fouled(new(new_rig, 0.5)).state.advantage.left == pytest.approx(0.5)
    assert fouled(new(new_rig, 0.0)).state.advantage is None


def test_no_advantage_for_a_side_without_the_ball(new_rig):
    rig = fouled(new(new_rig), holder="magenta3")
    assert kinds(rig, FOUL, ADVANTAGE) == [FOUL]


def test_no_advantage_where_an_opponent_is_nearer_to_the_loose_ball(new_rig):
    rig = new(new_rig).playing(BALL)
    rig.robots |= {"cyan3": (-1.0, 1.0), "cyan4": (0.0, -3.0), "magenta2": (0.5, -3.0), "magenta3": (2.0, 1.0)}
    rig.tick(BALL, ["cyan3"], kicked="cyan3")
    rig.tick(BALL, impacts=[("cyan4", "magenta2")], motions={"magenta2": (0.0, -2.0, 0.0)})
    assert kinds(rig, FOUL, ADVANTAGE) == [FOUL]


def test_a_penalty_is_better_than_an_advantage(new_rig):
    rig = new(new_rig)
    fouled(rig, x=rig.pitch.goal_line - 2.0)
    assert kinds(rig, FOUL, ADVANTAGE) == [FOUL] and rig.state.pending.phase is Phase.PENALTY


def test_the_card_of_a_foul_is_shown_at_the_next_stop(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    hold(rig, "cyan3", 4.0)
    assert kinds(rig, CARD, ADVANTAGE) == [ADVANTAGE, ADVANTAGE]
    rig.ask("stop")
    (card,) = [event for event in rig.events if event.kind is CARD]
    assert (card.rule, card.robot, card.card) == ("charging", "magenta2", Card.YELLOW)
    assert rig.state.participation.cards["magenta2"].yellow == 1 and rig.state.participation.owed == ()


def test_the_card_of_a_foul_whose_advantage_is_lost_is_shown_once(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    rig.tick((4.0, 2.0), ["magenta3"], possession="magenta3")
    rig.run(1.0)
    assert kinds(rig, FOUL, CARD, STOP) == [FOUL, CARD, STOP]


def test_people_who_stop_the_game_end_the_advantage_and_the_card_is_shown(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    rig.ask("stop")
    assert kinds(rig, FOUL, CARD) == [CARD] and rig.state.advantage is None and rig.state.pending is None
    rig = fouled(new(new_rig), speed=3.5)
    rig.ask("free_kick", MAGENTA, (3.0, 3.0))
    assert kinds(rig, FOUL, CARD) == [CARD] and rig.state.pending.side is MAGENTA


def goal(rig, sign, scorer):
    rig.tick((sign * (rig.pitch.goal_line - 0.1), 0.0), [scorer], kicked=scorer)
    return rig.tick((sign * (rig.pitch.goal_line + 0.3), 0.0))


def test_a_goal_by_the_advantage_counts_and_the_card_is_shown(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    goal(rig, 1, "cyan3")
    assert rig.state.score == Score(cyan=1) and rig.state.pending.phase is Phase.KICK_OFF
    assert kinds(rig, FOUL, CARD, EventKind.GOAL) == [EventKind.GOAL, CARD]


def test_a_goal_that_the_offenders_score_in_the_time_does_not_count(new_rig):
    rig = fouled(new(new_rig))
    rig.tick((-5.0, 0.0), ["magenta3"], kicked="magenta3")
    assert rig.state.score == Score() and rig.state.pending.side is CYAN and kinds(rig, FOUL) == [FOUL]


def test_an_own_goal_in_the_time_does_not_count(new_rig):
    rig = fouled(new(new_rig))
    goal(rig, -1, "cyan3")
    assert rig.state.score == Score() and kinds(rig, FOUL, EventKind.GOAL) == [FOUL]
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.FREE_KICK, CYAN)


@pytest.mark.parametrize(
    ("toucher", "phase", "foul"), [("cyan3", Phase.FREE_KICK, True), ("magenta3", Phase.THROW_IN, False)]
)
def test_a_ball_out_gives_the_throw_in_or_the_restart_for_the_foul(new_rig, toucher, phase, foul):
    """A throw-in that leaves cyan the ball is taken; one for the offenders is the end of the advantage."""
    rig = fouled(new(new_rig))
    touch = rig.pitch.touch_line
    rig.tick((3.0, touch - 0.1), [toucher])
    rig.tick((3.0, touch + 0.3))
    assert (rig.state.pending.phase, rig.state.pending.side) == (phase, CYAN)
    assert (FOUL in rig.kinds()) is foul and rig.state.advantage is None


def charge(rig, offender, victim, x=-4.0, speed=2.0, holder="cyan3"):
    rig.robots |= {victim: (x, 3.0), offender: (x + 0.5, 3.0)}
    rig.tick(touches=[holder], possession=holder, impacts=[(victim, offender)], motions={offender: (0.0, -speed, 0.0)})


def test_a_second_foul_of_the_offenders_is_decided_and_both_cards_are_shown(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    charge(rig, "magenta4", "cyan2", speed=3.5)
    called = [event.robot for event in rig.events if event.kind is FOUL]
    assert called == ["magenta4"] and rig.state.pending.side is CYAN
    assert {event.robot for event in rig.events if event.kind is CARD} == {"magenta2", "magenta4"}


def test_a_foul_of_the_side_with_the_advantage_brings_the_game_back_to_the_first(new_rig):
    rig = fouled(new(new_rig))
    charge(rig, "cyan2", "magenta5", speed=3.5)
    called = [event.robot for event in rig.events if event.kind is FOUL]
    assert called == ["magenta2"] and rig.state.pending.side is CYAN
    assert [event.robot for event in rig.events if event.kind is CARD] == ["cyan2"]


def test_a_foul_that_goes_on_is_noted_once_and_masks_no_other_rule(new_rig):
    """magenta5 stays in the goal area for the whole time; the half ends meanwhile."""
    rig = new_rig(advantage=3.0, duration=16.0, rules="msl").playing(BALL)
    rig.robots |= {"cyan3": (0.7, 1.0), "magenta5": (-rig.pitch.goal_line + 0.3, 0.5)}
    while rig.state.clock < 6.5:
        rig.robots["magenta5"] = (-rig.pitch.goal_line + (0.3 if rig.state.clock > 5.9 else 4.0), 0.5)
        hold(rig, "cyan3", rig.dt)
    hold(rig, "cyan3", 2.0)
    noted = [event for event in rig.events if event.kind is ADVANTAGE and event.rule == "goal_area"]
    assert len(noted) == 1 and rig.state.phase is Phase.PARKING and FOUL not in rig.kinds()


def test_the_end_of_a_half_ends_the_advantage_and_the_card_is_shown(new_rig):
    rig = new_rig(advantage=3.0, duration=40.0)
    rig.playing(BALL)
    while rig.state.clock < 18.9:
        hold(rig, "cyan3", rig.dt)
    fouled_now(rig)
    hold(rig, "cyan3", 2.0)
    assert rig.state.phase is Phase.PARKING and rig.state.advantage is None
    assert [event.robot for event in rig.events if event.kind is CARD] == ["magenta2"]


def fouled_now(rig):
    rig.robots |= {"cyan3": (0.7, 1.0), "cyan4": (0.0, -3.0), "magenta2": (0.5, -3.0)}
    seen = {"impacts": [("cyan4", "magenta2")], "motions": {"magenta2": (0.0, -3.5, 0.0)}}
    rig.tick(touches=["cyan3"], possession="cyan3", **seen)


def test_a_stalled_ball_in_the_time_brings_the_game_back_to_the_foul(new_rig):
    rig = fouled(new(new_rig, 20.0))
    rig.velocity = (0.0, 0.0, 0.0)
    hold(rig, "cyan3", 11.0)
    assert kinds(rig, FOUL, EventKind.STALL) == [FOUL] and rig.state.pending.side is CYAN


def test_in_mixed_officiating_the_foul_is_proposed_when_the_advantage_is_lost(new_rig):
    rig = fouled(new(new_rig, mode=OfficiatingMode.MIXED, proposal=2.0))
    assert kinds(rig, ADVANTAGE, EventKind.PROPOSAL) == [ADVANTAGE]
    rig.tick((4.0, 2.0), ["magenta3"], possession="magenta3")
    assert kinds(rig, ADVANTAGE, EventKind.PROPOSAL) == [ADVANTAGE, EventKind.PROPOSAL] and rig.state.running
    rig.run(2.1)
    assert rig.state.pending.side is CYAN and kinds(rig, FOUL) == [FOUL]


def test_in_mixed_officiating_people_may_overrule_it_then(new_rig):
    rig = fouled(new(new_rig, mode=OfficiatingMode.MIXED, proposal=2.0))
    rig.tick((4.0, 2.0), ["magenta3"], possession="magenta3")
    rig.ask("overrule")
    hold(rig, "magenta3", 3.0)
    assert rig.state.running and FOUL not in rig.kinds()


def test_in_manual_officiating_no_advantage_is_noted(new_rig):
    rig = new(new_rig, mode=OfficiatingMode.MANUAL, automatic=False)
    rig.ask("start")
    rig.tick()
    rig.ask("start")
    fouled(rig)
    assert kinds(rig, FOUL, ADVANTAGE) == []


def test_with_a_referee_box_the_advantage_is_played_and_ends_by_its_stop(new_rig):
    rig = new(new_rig)
    rig.refbox = True
    rig.ask("start")
    rig.tick()
    rig.ask("start")
    fouled(rig, speed=3.5)
    assert rig.state.advantage is not None
    rig.ask("stop")
    assert kinds(rig, FOUL, CARD) == [CARD] and rig.state.offender == "magenta2"


def test_undo_of_a_foul_after_its_advantage_leaves_no_advantage(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    rig.tick((4.0, 2.0), ["magenta3"], possession="magenta3")
    rig.ask("undo")
    assert rig.state.advantage is None and "magenta2" not in rig.state.participation.cards
    assert rig.state.pending.phase is Phase.DROP_BALL
    rig.until(lambda state: state.phase is Phase.PLAY)


def test_no_advantage_is_played_before_the_ball_is_in_play(new_rig):
    rig = new(new_rig).playing(BALL)
    rig.ask("free_kick", CYAN, (2.0, 1.0))
    rig.until(lambda state: state.running)
    rig.robots |= {"cyan4": (-3.0, -3.0), "magenta2": (-2.5, -3.0)}
    rig.tick(impacts=[("cyan4", "magenta2")], motions={"magenta2": (0.0, -2.0, 0.0)})
    assert kinds(rig, FOUL, ADVANTAGE) == [FOUL]


def test_an_operator_who_moves_bodies_ends_the_advantage(new_rig):
    """A robot that is gone is shown no card, and decides nothing."""
    rig = fouled(new(new_rig), speed=3.5)
    stays = rig.state.after_layout_change(rig.roster.names)
    assert stays.advantage is None and [card.robot for card in stays.participation.owed] == ["magenta2"]
    gone = rig.state.after_layout_change([name for name in rig.roster.names if name != "magenta2"])
    assert gone.advantage is None and gone.participation.owed == ()


def test_a_proposal_on_a_robot_that_is_gone_is_dropped(new_rig):
    rig = fouled(new(new_rig, 0.0, mode=OfficiatingMode.MIXED, proposal=2.0))
    assert rig.state.after_layout_change(rig.roster.names).proposal is not None
    assert rig.state.after_layout_change(("cyan1", "magenta1")).proposal is None


def test_an_advantage_and_owed_cards_are_part_of_the_recorded_state(new_rig):
    rig = fouled(new(new_rig), speed=3.5)
    assert state_from_json(state_json(rig.state)) == rig.state
    hold(rig, "cyan3", 4.0)
    assert rig.state.participation.owed and state_from_json(state_json(rig.state)) == rig.state
