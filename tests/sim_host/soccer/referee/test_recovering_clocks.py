"""Clocks of areas and of the field's outside: they run down outside, so that a step out gives no new time."""

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, OfficiatingMode, Phase
from sim_host.soccer.referee.evidence.stays import NO_STAYS

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def places(rig, rule):
    """Where the robot may not stay, where it may, and how long it may stay."""
    line, touch = rig.pitch.goal_line, rig.pitch.touch_line
    inside, limit = {
        "penalty_area": ((line - 1.5, 2.5), rig.book.areas.penalty_area_stay),
        "goal_area": ((line - 0.3, 0.5), rig.book.areas.goal_area_duration),
        "leaving_field": ((1.0, touch + rig.hull + 0.01), rig.book.contact.outside_duration),
    }[rule]
    return inside, (2.0, 4.0), limit


def hop(rig, rule, share, out, rounds):
    """Stay for a share of the time allowed, step out for `out` s, and again."""
    inside, away, limit = places(rig, rule)
    for _ in range(rounds):
        rig.robots["cyan3"] = inside
        rig.play_on(share * limit)
        rig.robots["cyan3"] = away
        rig.play_on(out)


RULES = ["penalty_area", "goal_area", "leaving_field"]


@pytest.mark.parametrize("rule", RULES)
def test_a_robot_that_steps_out_for_a_tick_before_its_time_is_up_is_called(new_rig, rule):
    rig = new_rig().playing()
    hop(rig, rule, 0.9, rig.dt, 2)
    assert rig.fouls() == [(rule, "cyan3")]
    limit = places(rig, rule)[2]
    event = next(event for event in rig.events if event.kind is EventKind.FOUL)
    assert limit < event.measured <= limit + 2 * rig.dt


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize(("rest", "called"), [(0.7, True), (0.9, False)])
def test_a_second_outside_gives_a_second_back(new_rig, rule, rest, called):
    """Inside for 0.9 of the time, outside for `rest` of it, inside for 0.9 again."""
    rig = new_rig().playing()
    inside, _, limit = places(rig, rule)
    hop(rig, rule, 0.9, rest * limit, 1)
    rig.robots["cyan3"] = inside
    rig.play_on(0.9 * limit)
    assert bool(rig.fouls()) is called


@pytest.mark.parametrize("rule", RULES)
def test_a_robot_that_is_away_for_as_long_as_it_was_inside_leaves_no_clock(new_rig, rule):
    rig = new_rig().playing()
    hop(rig, rule, 0.9, places(rig, rule)[2], 1)
    assert rig.state.evidence.stays is NO_STAYS and rig.state.evidence.outside == ()


@pytest.mark.parametrize("rule", RULES)
def test_a_robot_outside_is_not_called_while_its_clock_runs_down(new_rig, rule):
    """Also after people have overruled a decision, by which the clock has passed its limit."""
    rig = new_rig(mode=OfficiatingMode.MIXED, proposal=1.0).playing()
    inside, away, limit = places(rig, rule)
    rig.robots["cyan3"] = inside
    rig.play_on(limit + 2 * rig.dt)
    assert rig.state.proposal is not None
    rig.robots["cyan3"] = away
    assert rig.ask("overrule").replies[0].accepted
    rig.play_on(0.5 * limit)
    assert rig.state.proposal is None and rig.fouls() == []


def test_the_robot_that_came_last_is_named_first(new_rig):
    rig = new_rig().playing()
    rig.robots["cyan4"] = (rig.pitch.goal_line - 1.5, 3.0)
    rig.play_on(3.0)
    rig.robots["cyan3"] = (rig.pitch.goal_line - 1.5, 0.0)
    rig.tick((rig.pitch.goal_line - 2.0, 0.0))
    event = next(event for event in rig.events if event.kind is EventKind.FOUL)
    assert event.robots == ["cyan3", "cyan4"]


@pytest.mark.parametrize("mirrored", [False, True])
def test_of_two_crowds_that_form_together_the_attackers_are_called_whatever_their_colour(new_rig, mirrored):
    rig = new_rig(mirrored=mirrored).playing()
    x = rig.pitch.goal_line - 1.5
    for place, name in enumerate(("cyan3", "cyan4", "magenta3", "magenta4")):
        rig.robots[name] = (x, -2.4 + 1.6 * place)
    rig.tick()
    event = next(event for event in rig.events if event.kind is EventKind.FOUL)
    assert "illegal attack" in event.text and event.side is rig.side(CYAN)


def test_a_crowd_that_parts_for_a_tick_is_called_when_its_time_is_up(new_rig):
    """In a friendly a crowd may stay for a while."""
    rig = new_rig("msl", "friendly").playing()
    limit, x = rig.book.areas.penalty_area_duration, rig.pitch.goal_line - 1.5
    rig.robots["cyan4"] = (x, 3.0)
    for _ in range(2):
        rig.robots["cyan3"] = (x, 0.0)
        rig.play_on(0.9 * limit)
        rig.robots["cyan3"] = (5.0, 0.0)
        rig.tick()
    assert rig.fouls() == [("penalty_area", "cyan3")] or rig.fouls() == [("penalty_area", "cyan4")]


def test_robots_that_the_referee_moves_are_not_put_into_a_penalty_area_where_their_time_would_run(new_rig):
    """Around the spot of a corner, three of a side in wrong positions, and two of the other."""
    rig = new_rig("paper").playing()
    rig.ask("corner", CYAN)
    rig.until(lambda state: state.phase is Phase.CORNER)
    x, y = rig.state.spot
    for place, name in enumerate(("magenta3", "magenta4", "magenta5", "cyan4", "cyan5")):
        rig.robots[name] = (x - 0.3 - 0.6 * place, y - 1.0)
    rig.until(lambda state: state.running)
    rig.tick()
    assert rig.state.running and rig.state.evidence.stays is NO_STAYS


def test_stop_ends_all_clocks(new_rig):
    rig = new_rig().playing()
    rig.robots["cyan3"] = places(rig, "penalty_area")[0]
    rig.play_on(9.0)
    rig.ask("free_kick", MAGENTA, (4.0, 0.0))
    rig.until(lambda state: state.running)
    assert rig.state.evidence.stays is NO_STAYS
