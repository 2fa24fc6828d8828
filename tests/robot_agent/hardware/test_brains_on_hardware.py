"""The brains that ship, and programs in other languages, on the simulated hardware: unchanged."""

import math
import shutil
import subprocess
from pathlib import Path

import pytest

from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from robot_agent.process.hardware_runner import RunnerWithoutHost
from robot_agent.process.robot_code import end_robot, start_robot
from robot_agent.sdk.contract import Briefing
from support.in_process_bus import SharedState
from support.messages import make_setup
from support.stepped_board import SteppedBoard

EXAMPLES = Path(__file__).parents[3] / "examples" / "stdio_robot"
START = (-2.0, 1.5, 0.5)


def compiled(folder):
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("requires a C compiler")
    program = folder / "robot"
    subprocess.run([compiler, "-std=c99", "-O2", "-o", program, EXAMPLES / "robot.c", "-lm"], check=True)
    return [str(program)]


@pytest.mark.parametrize("brain", ["simple", "nubot", "reference", "random", "robot.c"])
def test_each_brain_drives_the_simulated_hardware_to_the_ball_and_moves_it(brain, tmp_path):
    setup = make_setup(size=2)
    stdio = compiled(tmp_path) if brain == "robot.c" else None
    stepped = SteppedBoard(setup.model_of("cyan2"), start=START, ball=(0.0, 0.0))
    settings = HardwareSettings(hardware="simulated")
    guard = HardwareGuard(stepped.hardware, settings, setup.model_of("cyan2"), "cyan2", stepped.clock, armed=True)
    started = start_robot("" if stdio else brain, stdio, Briefing.of("cyan2", setup))
    guard.start()
    bus = SharedState().open_bus("friendly", stepped.clock)
    runner = RunnerWithoutHost(guard, setup, bus, started, "cyan2")
    way = 0.0
    try:
        while stepped.clock.now() < 12.0:
            before = stepped.board.x, stepped.board.y
            sight = runner.next_sight(None)
            if sight is not None:
                runner.answer(sight)
            way += math.dist(before, (stepped.board.x, stepped.board.y))
    finally:
        end_robot(started)
        guard.stop()
        stepped.close()
    assert way > 0.5
    health = guard.health()
    assert (health.fell_back, health.calls["actuate"].late) == (0, 0)
    assert sum(device.refused for device in health.devices.values()) == 0
    assert stepped.board.ball[:2] != [0.0, 0.0]
