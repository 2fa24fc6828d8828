"""The stuck flag: the progress of each robot, and what counts as held back in the velocity drive."""

from collections.abc import Sequence
from typing import Any

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.snapshot import RobotState, RobotStates

MSL = load_profile("msl")
ROBOT = RobotModel.standard(MSL)
AHEAD = Drive(vx=2.0)
STANDS = RobotState(0, 0, 0.4, 0, 0, 0, 0, False)


def update(watch: StuckDetector, indices: Sequence[int], held: Sequence[bool]) -> None:
    count = len(indices)
    watch.update(indices, held, [STANDS] * count, [AHEAD] * count)


def test_each_robot_has_its_own_clock() -> None:
    """In simatch all robots share one counter."""
    watch = StuckDetector([ROBOT] * 3, tick=0.05)
    for _ in range(20):
        update(watch, [0, 2], [False, True])
        update(watch, [1], [False])
    assert watch.stuck() == [False, False, True]
    watch.reset()
    assert watch.stuck() == [False] * 3


def test_demands_that_flicker_do_not_hide_that_a_robot_stands() -> None:
    """Held back in every other tick, and at rest."""
    watch = StuckDetector([ROBOT], tick=0.02)
    for tick in range(60):
        update(watch, [0], [tick % 2 == 0])
    assert watch.stuck() == [True]


def held(told: tuple[float, float, float], measured: tuple[float, float, float]) -> list[bool]:
    """Three robots with the same demand for a while; the second one moves only as measured."""
    bodies: Any = None  # this drive reads no bodies
    drive = VelocityDrive(MSL.time, [RobotModel.standard(MSL)] * 3)
    commands = [Drive(vx=told[0], vy=told[1], omega=told[2])] * 3
    last: Sequence[Sequence[float]] = [(0.0, 0.0, 0.0)] * 3
    for _ in range(50):
        moving = [last[0], measured, last[2]]
        robots = RobotStates(RobotState(0, 0, 0.4, 0, *twist, False) for twist in moving)
        *_, last = drive.plan(robots, commands, bodies)
    return list(drive.held_back)


def test_a_robot_well_below_its_demand_is_held_back_in_driving_and_in_turning() -> None:
    """As in simatch: translation, else rotation."""
    assert held((2, 0, 0), (0, 0, 0)) == [False, True, False]
    assert held((2, 0, 0), (1.5, 0, 0)) == [False] * 3
    assert held((0, 0, 5), (0, 0, 0)) == [False, True, False]
    assert held((0, 0, 5), (0, 0, 4)) == [False] * 3
    assert held((0, 0, 0.3), (0, 0, 0)) == [False] * 3
