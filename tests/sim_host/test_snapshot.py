"""Robots as numbers and as arrays."""

import copy
import pickle

import pytest

from sim_host.snapshot import RobotState, RobotStates

ROBOTS = RobotStates(
    RobotState(place - 1.5, 0.5 * place, 0.4, 0.1 * place, -0.0, 2.0 - place, 3.0, place == 1) for place in range(3)
)


@pytest.mark.parametrize("robots", [ROBOTS, copy.deepcopy(ROBOTS), pickle.loads(pickle.dumps(ROBOTS))])
def test_the_arrays_of_robots_hold_what_the_robots_do(robots: RobotStates) -> None:
    assert robots == ROBOTS
    motions = robots.motions
    for place, robot in enumerate(robots):
        assert motions.position[place] == complex(robot.x, robot.y)
        assert motions.velocity[place] == complex(robot.vx, robot.vy)
        assert (motions.heading[place], motions.omega[place]) == (robot.heading, robot.omega)


def test_of_no_robots_the_arrays_are_empty() -> None:
    assert [len(array) for array in RobotStates(()).motions] == [0, 0, 0, 0]
