"""Who is stuck: a clock for each robot, and what starts it in the velocity drive."""

import numpy as np
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.snapshot import RobotState, RobotStates

MSL = load_profile("msl")


def test_each_robot_has_its_own_clock() -> None:
    """Time based; in simatch all robots share one counter."""
    watch = StuckDetector(3, tick=0.05)
    for _ in range(4):
        watch.update([0, 2], np.array([False, True]))
        watch.update([1], np.array([False]))
    assert watch.stuck() == [False, False, True]
    watch.update([0, 2], np.array([True, False]))
    assert watch.stuck() == [False] * 3


def test_the_time_to_be_stuck_does_not_depend_on_the_tick() -> None:
    """0.2 s, whether they are 4 ticks or 20 (simatch: 40 checks at 5 ms)."""
    for ticks in (4, 20):
        watch, tick = StuckDetector(1, tick=0.2 / ticks), 0
        while not watch.stuck()[0]:
            watch.update([0], np.array([True]))
            tick += 1
        assert tick == approx(ticks, abs=1)


def held(told: tuple[float, float, float], measured: tuple[float, float, float]) -> list[bool]:
    """Three robots with the same demand for a while; the second one moves only as measured."""
    drive = VelocityDrive(MSL.time, [RobotModel.standard(MSL)] * 3)
    commands = [Drive(vx=told[0], vy=told[1], omega=told[2])] * 3
    last = [(0.0, 0.0, 0.0)] * 3
    for _ in range(50):
        moving = [last[0], measured, last[2]]
        last = drive.plan(RobotStates(RobotState(0, 0, 0.4, 0, *twist, False) for twist in moving), commands)[-1]
    flags: list[bool] = drive.held_back.tolist()
    return flags


def test_a_robot_well_below_its_demand_is_held_back_in_driving_and_in_turning() -> None:
    """As in simatch: translation, else rotation."""
    assert held((2, 0, 0), (0, 0, 0)) == [False, True, False]
    assert held((2, 0, 0), (1.5, 0, 0)) == [False] * 3
    assert held((0, 0, 5), (0, 0, 0)) == [False, True, False]
    assert held((0, 0, 5), (0, 0, 4)) == [False] * 3
    assert held((0, 0, 0.3), (0, 0, 0)) == [False] * 3
