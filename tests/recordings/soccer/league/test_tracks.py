"""What is derived from the records of a league's log: velocities, and kicks."""

import math

import numpy as np
import pytest

from recordings.soccer.league.record_motion import ROBOT, body_records
from recordings.soccer.league.record_values import RobotRow
from recordings.soccer.league.tracks import Track, kicks
from schemas.messages.soccer.league.findings import Findings

RECORD_S = 0.04
PERIOD_S = 0.1


def test_a_derived_velocity_is_that_in_the_middle_of_its_window() -> None:
    rows: list[RobotRow] = [
        (40.0 * number, (number * RECORD_S) ** 2, 0.0, 0.0, math.nan, math.nan, 0.0, 0.0) for number in range(50)
    ]
    velocities = body_records(rows, "robot 1 of A", ROBOT, Findings()).rows[:, 4:6]
    inside = np.arange(50)[4:-4]
    assert velocities[inside, 0] == pytest.approx(2.0 * inside * RECORD_S)
    assert velocities[:, 1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("away_m", "kicked"), [(0.7, {}), (0.9, {2: "cyan1"})])
def test_a_kick_is_told_by_the_way_of_the_ball_from_where_its_holder_lost_it(
    away_m: float, kicked: dict[int, str]
) -> None:
    """The robot drives back at once; its later places count for nothing."""
    count, known = 10, np.ones(10, bool)
    robot, ball = np.zeros((7, count)), np.zeros((7, count))
    robot[6, :2] = 1.0
    robot[0, 2:] = -3.0
    ball[0, 2:] = away_m
    assert kicks({"cyan1": Track(known, robot)}, Track(known, ball), PERIOD_S) == kicked
