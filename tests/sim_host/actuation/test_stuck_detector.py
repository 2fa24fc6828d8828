"""The stuck flag without a window: a timer for each robot, and what starts it in the velocity drive."""

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.sections import DriveLimits
from schemas.messages.command import Drive
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.snapshot import RobotState, RobotStates

MSL = load_profile("msl")
TIMED = replace(RobotModel.standard(MSL), drive=replace(MSL.drive, stuck_window=0.0))
AHEAD = Drive(vx=2.0)
STANDS = RobotState(0, 0, 0.4, 0, 0, 0, 0, False)


def update(watch: StuckDetector, indices: Sequence[int], held: Sequence[bool]) -> None:
    count = len(indices)
    watch.update(indices, np.array(held), [STANDS] * count, [AHEAD] * count)


def test_each_robot_has_its_own_clock() -> None:
    """Time based; in simatch all robots share one counter."""
    watch = StuckDetector([TIMED] * 3, tick=0.05)
    for _ in range(4):
        update(watch, [0, 2], [False, True])
        update(watch, [1], [False])
    assert watch.stuck() == [False, False, True]
    update(watch, [0, 2], [True, False])
    assert watch.stuck() == [False] * 3


def test_the_time_to_be_stuck_does_not_depend_on_the_tick() -> None:
    """0.2 s, whether they are 4 ticks or 20 (simatch: 40 checks at 5 ms)."""
    for ticks in (4, 20):
        watch, tick = StuckDetector([TIMED], tick=0.2 / ticks), 0
        while not watch.stuck()[0]:
            update(watch, [0], [True])
            tick += 1
        assert tick == approx(ticks, abs=1)


def test_robots_with_and_without_a_window_have_the_flag_of_their_own_rule() -> None:
    """Held back in every other tick, and at rest: the timer never runs out, and there is no progress."""
    watch = StuckDetector([TIMED, RobotModel.standard(MSL)], tick=0.02)
    for tick in range(60):
        update(watch, [0, 1], [tick % 2 == 0] * 2)
    assert watch.stuck() == [False, True]
    watch.reset()
    assert watch.stuck() == [False, False]


def test_a_recording_of_before_has_the_flag_of_before() -> None:
    (default,) = (field.default for field in fields(DriveLimits) if field.name == "stuck_window")
    assert replace(MSL.drive, stuck_window=default) == TIMED.drive


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
