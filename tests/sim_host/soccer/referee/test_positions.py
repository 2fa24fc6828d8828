"""Where robots may stand before START; the rig's robots all stand legally, one is moved in each test."""

import pytest

from schemas.side import Side
from schemas.soccer.game import Phase
from sim_host.soccer.referee.game.restart import Restart
from sim_host.soccer.referee.placement.positions import position_faults

EDGE = 0.01


def judged(rig, phase, spot, robots, taker=Side.CYAN):
    rig.robots.update(robots)
    side = None if phase is Phase.DROP_BALL else taker
    match = rig.constants
    faults = position_faults(match, rig.state, Restart(phase, side, spot), rig.snapshot())
    return faults[0].text if faults else None


def test_robots_far_away_stand_legally_at_every_restart(rig):
    assert judged(rig, Phase.KICK_OFF, (0.0, 0.0), {}) is None
    assert judged(rig, Phase.DROP_BALL, (0.0, 0.0), {}) is None


@pytest.mark.parametrize(
    ("phase", "robot", "number"),
    [
        (Phase.FREE_KICK, "magenta2", "opponent_distance"),
        (Phase.THROW_IN, "magenta1", "opponent_distance"),
        (Phase.FREE_KICK, "cyan3", "teammate_distance"),
        (Phase.DROP_BALL, "cyan3", "drop_ball_distance"),
        (Phase.DROP_BALL, "magenta3", "drop_ball_distance"),
    ],
)
def test_distances_are_measured_to_the_whole_robot(rig, phase, robot, number):
    asked = getattr(rig.book.restarts, number) + rig.hull
    kicker = {} if phase is Phase.DROP_BALL else {"cyan2": (0.0, -0.5)}
    assert judged(rig, phase, (0.0, 0.0), kicker | {robot: (asked + EDGE, 0.0)}) is None
    fault = judged(rig, phase, (0.0, 0.0), kicker | {robot: (asked - EDGE, 0.0)})
    assert fault.startswith(f"{robot} stands {asked - EDGE - rig.hull:.2f} m from the ball")


def test_each_robot_is_measured_by_its_own_hull(new_rig):
    """A goalkeeper with a frame of 0.6 m reaches 0.387 m, and stands too near where a round robot does not."""
    rig = new_rig("msl", magenta_types={"magenta3": "keeper"})
    away = rig.book.restarts.opponent_distance + rig.hull + EDGE
    kicker = {"cyan2": (0.0, -0.5)}
    assert judged(rig, Phase.FREE_KICK, (0.0, 0.0), kicker | {"magenta2": (away, 0.0)}) is None
    assert "magenta3 stands" in judged(rig, Phase.FREE_KICK, (0.0, 0.0), kicker | {"magenta3": (away, 0.0)})


def test_the_nearest_of_the_takers_is_its_kicker_and_may_stand_at_the_ball(rig):
    assert judged(rig, Phase.FREE_KICK, (0.0, 0.0), {"cyan2": (0.0, -0.5)}) is None


@pytest.mark.parametrize(("robot", "own"), [("cyan3", -1), ("magenta3", 1)])
def test_at_a_kick_off_whole_robots_are_in_their_own_halves(rig, robot, own):
    aside = {"cyan2": (-0.5, 0.0)}
    assert judged(rig, Phase.KICK_OFF, (0.0, 0.0), aside | {robot: (own * (rig.hull + EDGE), 4.0)}) is None
    assert "other half" in judged(rig, Phase.KICK_OFF, (0.0, 0.0), aside | {robot: (own * (rig.hull - EDGE), 4.0)})


@pytest.mark.parametrize(("x", "legal"), [(-EDGE, True), (EDGE, False)])
def test_at_a_kick_off_the_kicker_may_lean_over_the_line_with_half_its_body(rig, x, legal):
    assert (judged(rig, Phase.KICK_OFF, (0.0, 0.0), {"cyan2": (x, 0.5)}) is None) == legal


def test_one_defender_may_be_near_in_its_own_penalty_area_but_not_in_the_goal_area_nor_two(rig):
    line, depth = rig.pitch.goal_line, rig.pitch.penalty_area_depth
    spot = (line - depth - 0.5, 0.0)
    deep = line - rig.pitch.goal_area_depth
    assert judged(rig, Phase.FREE_KICK, spot, {"magenta2": (deep - EDGE, 0.0)}) is None
    assert "magenta2" in judged(rig, Phase.FREE_KICK, spot, {"magenta2": (deep + EDGE, 0.0)})
    two = {"magenta2": (deep - 0.5, 1.0), "magenta3": (deep - 0.6, 1.0)}
    assert "magenta2" in judged(rig, Phase.FREE_KICK, spot, two)


def test_the_goalkeeper_may_be_near_in_its_own_penalty_area(rig):
    spot = (rig.pitch.goal_line - rig.pitch.penalty_area_depth - 0.2, 0.0)
    assert judged(rig, Phase.FREE_KICK, spot, {"magenta1": (rig.pitch.goal_line - 0.3, 0.0)}) is None


def test_at_a_penalty_only_the_goalkeeper_waits_in_the_area_and_only_in_its_goal_area(rig):
    line, mark = rig.pitch.goal_line, rig.pitch.goal_line - rig.pitch.penalty_mark
    away = {f"magenta{n}": (0.0, 2.0 + 0.8 * n) for n in range(2, 6)} | {"cyan2": (mark - 1.0, 0.0)}
    legal = away | {"magenta1": (line - 0.3, 0.0)}
    assert judged(rig, Phase.PENALTY, (mark, 0.0), legal) is None
    strayed = legal | {"magenta1": (line - rig.pitch.goal_area_depth - EDGE, 0.0)}
    assert "goal area" in judged(rig, Phase.PENALTY, (mark, 0.0), strayed)
    crowded = legal | {"cyan3": (line - 0.5, rig.pitch.penalty_area_width / 2 + rig.hull - EDGE)}
    assert "cyan3 stands in the penalty area" in judged(rig, Phase.PENALTY, (mark, 0.0), crowded)
    near = legal | {"cyan3": (mark - rig.book.restarts.opponent_distance - rig.hull + EDGE, 0.0)}
    assert "cyan3" in judged(rig, Phase.PENALTY, (mark, 0.0), near)
