"""Who holds the ball: the hold condition to the edge, and fairness."""

import math

import pytest

from schemas.config.profile import load_profile
from sim_host.snapshot import BallState, RobotState
from sim_host.soccer.ball.possession import can_hold, claimants, holder

DRIBBLE = load_profile("msl").dribble
EPSILON = 1e-6


def robot(x: float = 0.0, y: float = 0.0, heading: float = 0.0) -> RobotState:
    return RobotState(x, y, 0.4, heading, 0, 0, 0, False)


def ball(distance: float, bearing: float = 0.0, z: float = 0.11) -> BallState:
    return BallState(distance * math.cos(bearing), distance * math.sin(bearing), z, 0, 0, 0)


@pytest.mark.parametrize(
    ("seen", "held"),
    [
        (ball(DRIBBLE.distance - EPSILON), True),
        (ball(DRIBBLE.distance + EPSILON), False),
        (ball(0.35, DRIBBLE.cone / 2 - EPSILON), True),
        (ball(0.35, -DRIBBLE.cone / 2 + EPSILON), True),
        (ball(0.35, DRIBBLE.cone / 2 + EPSILON), False),
        (ball(0.35, -DRIBBLE.cone / 2 - EPSILON), False),
        (ball(0.35, math.pi), False),
        (ball(0.35, z=DRIBBLE.max_ball_height - EPSILON), True),
        (ball(0.35, z=DRIBBLE.max_ball_height + EPSILON), False),
    ],
)
def test_a_ball_is_held_within_distance_total_cone_and_height(seen: BallState, held: bool) -> None:
    """The cone is the whole one, half of it to either side."""
    assert can_hold(robot(), seen, DRIBBLE) is held


def test_the_nearest_of_those_that_want_it_holds_the_ball() -> None:
    robots = (robot(-0.36), robot(0.38, heading=math.pi), robot(0.0, 0.35, heading=-math.pi / 2))
    assert holder(claimants([0, 1], robots, ball(0), [DRIBBLE] * 3)) == 0
    assert holder(claimants([0, 1, 2], robots, ball(0), [DRIBBLE] * 3)) == 2
    assert holder(claimants([1], robots, ball(0), [DRIBBLE] * 3)) == 1
    assert holder(claimants([], robots, ball(0), [DRIBBLE] * 3)) is None


def test_two_equal_claims_leave_the_ball_free_in_any_order_of_robots() -> None:
    """In simatch the last writer had the ball."""
    robots = (robot(-0.35), robot(0.352, heading=math.pi))
    assert holder(claimants([0, 1], robots, ball(0), [DRIBBLE] * 3)) is None
    assert holder(claimants([1, 0], robots[::-1], ball(0), [DRIBBLE] * 3)) is None


def test_a_claim_that_cannot_hold_the_ball_does_not_contest_it() -> None:
    robots = (robot(-0.35), robot(0.35, heading=0.0))
    assert holder(claimants([0, 1], robots, ball(0), [DRIBBLE] * 3)) == 0
