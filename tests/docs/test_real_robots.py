"""docs/real_robots.md: its class is hardware, its tables are complete, and its commands drive a robot."""

import asyncio
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings, hardware_settings
from robot_agent.sdk.contract import Briefing
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive
from schemas.topics import COMMAND
from support.gateway_bench import until
from support.messages import make_setup
from support.referee_box import Box
from support.stepped_board import track_on_board
from support.stepped_clock import SteppedClock
from touchline.hardware.robot_track import RobotTrack, path_distance
from touchline.play.play_match import InProcessMatch

Fenced = Callable[[str, str], list[str]]


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "real_robots.md").read_text("utf-8")


class Line:
    """The serial line that the page's class opens."""

    def __init__(self) -> None:
        self.sent: list[str] = []

    def send(self, text: str) -> None:
        self.sent.append(text)

    def pose(self) -> tuple[float, float, float]:
        return 1.0, 2.0, 0.5

    def ball(self) -> tuple[float, float]:
        return 3.0, 0.1

    def close(self) -> None:
        self.sent.append("close")


def test_its_class_is_hardware_that_a_guard_drives(page: str, fenced: Fenced) -> None:
    line = Line()
    names: dict[str, Any] = {"open_line": lambda port: line if port == "/dev/ttyUSB0" else None}
    exec(fenced(page, "python")[0], names)  # the documents are ours
    model, clock = make_setup("differential").model_of("cyan2"), SteppedClock()
    hardware = names["TwoWheels"](model)
    guard = HardwareGuard(hardware, HardwareSettings(hardware="page"), model, "cyan2", clock, armed=True)
    guard.start()
    for _ in range(50):
        clock.sleep_until(clock.now() + 0.02)
        readings = guard.sense()
        guard.actuate(Command(answers_tick=1, drive=Drive(vx=0.5, omega=1.0)))
    guard.stop()
    assert readings.motion is not None and readings.motion.x == 1.0 and readings.picture is not None
    assert line.sent[0] == "power on" and line.sent[-2:] == ["power off", "close"]
    arm = model.wheels.arm
    assert line.sent[-3] == f"speeds {0.5 - arm:.3f} {0.5 + arm:.3f}"


def test_all_keys_of_a_hardware_file_are_listed_with_their_defaults(page: str) -> None:
    rows = dict(re.findall(r"^\| `(\w+)` \| `?([^|`]+)`? \|", page, re.MULTILINE))
    given = {name: field.get_default() for name, field in HardwareSettings.model_fields.items() if field.default}
    assert list(rows) == list(HardwareSettings.model_fields)
    assert {name: rows[name] for name in given if rows[name] != "–"} == {
        name: str(default) for name, default in given.items() if rows[name] != "–"
    }


def test_one_brain_drives_nearly_the_same_path_in_a_match_and_on_simulated_hardware(root: Path, page: str) -> None:
    """The figure of the page, whose recordings are those of real processes."""
    config = load_match(root / "examples" / "two_bodies" / "rounds.toml")
    match = InProcessMatch(config, brain_folder=root / "examples" / "two_bodies")
    simulated = RobotTrack("cyan1", [], [])
    brain = type(match.brains["cyan1"])(Briefing.of("cyan1", match.simulation.setup()))
    while not match.simulation.over:
        simulated.sights.append(match.simulation.now.sights.perceived["cyan1"])
        match.step()
    setup = match.simulation.setup()
    match.close()
    mean, most = path_distance(simulated, track_on_board(brain, "cyan1", setup, 20.0))
    stated = re.search(r"([\d.]+) m apart on average, ([\d.]+) m at most", page)
    assert stated is not None
    assert mean < 1.5 * float(stated[1]) < 0.1 and most < 1.5 * float(stated[2]) < 0.4


@contextmanager
def running(command: list[str], folder: Path) -> Iterator[subprocess.Popen[str]]:
    """A process of the page, which is interrupted at the end."""
    process = subprocess.Popen(
        [sys.executable, "-m", "touchline", *command], cwd=folder, stderr=subprocess.PIPE, text=True
    )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        sys.stderr.write(process.communicate(timeout=20.0)[1])


@pytest.mark.processes
def test_its_commands_drive_record_and_show_simulated_hardware(page: str, fenced: Fenced, tmp_path: Path) -> None:
    (tmp_path / "robot.toml").write_text("watchdog = 9.0  # for a busy machine\n" + fenced(page, "toml")[0])
    (tmp_path / "match.toml").write_text("")
    assert hardware_settings(str(tmp_path / "robot.toml")).options["ball"] == [1.0, 0.0]
    endpoint = with_free_port("tcp/127.0.0.1:0")
    typed = fenced(page, "sh")[0].replace('"', "").replace("tcp/127.0.0.1:7447", endpoint)
    agent, record, health, info = (line.split()[1:] for line in typed.splitlines())
    with running([*agent, "--listen", endpoint], tmp_path) as robot:
        with running(record, tmp_path) as recorder:
            deadline = time.monotonic() + 60.0
            shown = ""
            while "sense()" not in shown and time.monotonic() < deadline:
                shown = _run(health, tmp_path)
            assert re.search(r"cyan2 +active, armed +motion", shown)
            time.sleep(2.0)
        assert recorder.returncode == 0
    assert robot.returncode == 0
    assert re.search(r"robot/cyan2/command +json +object +\d{2,}", _run(info, tmp_path)), _run(info, tmp_path)


@pytest.mark.processes
@pytest.mark.long
def test_its_example_of_two_bodies_is_played_driven_recorded_and_drawn_as_typed(
    page: str, fenced: Fenced, root: Path, tmp_path: Path
) -> None:
    shutil.copytree(root / "examples", tmp_path / "examples")
    endpoint = with_free_port("tcp/127.0.0.1:0")
    typed = fenced(page, "sh")[1].replace('"', "").replace("tcp/127.0.0.1:7447", endpoint).splitlines()
    match, agent, record = (line.split()[1:] for line in typed if line.startswith("touchline"))
    folder = tmp_path / typed[1].removeprefix("cd ")
    _run(match, tmp_path)
    with running([*agent, "--listen", endpoint, "--patience", "60"], folder), running(record, folder):
        deadline = time.monotonic() + 60.0
        while not (folder / "run.mcap").exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        time.sleep(14.0)
    drawn = [
        sys.executable,
        root / "docs" / "generate" / "draw_two_bodies.py",
        tmp_path / "sim.mcap",
        folder / "run.mcap",
    ]
    done = subprocess.run([*drawn, "cyan1", tmp_path / "two.png"], capture_output=True, text=True, check=True)
    assert re.fullmatch(r"0\.0\d+ m apart on average, 0\.\d+ m at most\n", done.stdout)
    assert (tmp_path / "two.png").exists()


@pytest.mark.processes
@pytest.mark.slow
@pytest.mark.anyio
async def test_its_commands_let_robots_obey_the_leagues_box_without_a_host(
    page: str, fenced: Fenced, tmp_path: Path
) -> None:
    (tmp_path / "robot.toml").write_text("watchdog = 9.0  # for a busy machine\n" + fenced(page, "toml")[0])
    (tmp_path / "match.toml").write_text(fenced(page, "toml")[1])
    endpoint, box = with_free_port("tcp/127.0.0.1:0"), Box()
    port = await box.open()
    (typed,) = (block for block in fenced(page, "sh") if "--refbox" in block)
    typed = typed.replace("tcp/127.0.0.1:7447", endpoint).replace("192.168.1.2", f"127.0.0.1:{port}")
    bridge, agent, stop, watch = (line.split()[1:] for line in typed.splitlines())
    with running(bridge, tmp_path), running([*agent, "--patience", "60"], tmp_path):
        with open_client("friendly", WallClock(), endpoint, 60.0) as bus:
            commands = bus.subscribe(COMMAND)

            def speeds() -> list[float]:
                drives = [one.message().drive for one in iter(commands.receive, None)]
                return [math.hypot(drive.vx, drive.vy) for drive in drives]

            await until(lambda: box.links and speeds() == [0.0], "a robot that waits")
            box.say("START")
            await until(lambda: max(speeds(), default=0.0) > 0.5, "play")
            box.say("STOP")
            await until(lambda: speeds() == [0.0], "rest")
            box.say("START")
            await until(lambda: max(speeds(), default=0.0) > 0.5, "play again")
            assert await asyncio.to_thread(_run, stop, tmp_path) == "stop accepted\n"
            await until(lambda: speeds() == [0.0], "rest again")
        shown = await asyncio.to_thread(_first_line, watch, tmp_path)
        assert "half 1  Simple 0 : 0 NuBot" in shown
    await box.close()


def _first_line(command: list[str], folder: Path) -> str:
    """What a command that goes on prints first."""
    words = [sys.executable, "-m", "touchline", *command]
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        process.send_signal(signal.SIGINT)
    return line


def _run(command: list[str], folder: Path) -> str:
    environment = {**os.environ, "COLUMNS": "200"}
    made = [sys.executable, "-m", "touchline", *command]
    return subprocess.run(made, cwd=folder, capture_output=True, text=True, timeout=60, env=environment).stdout


def test_its_hardware_file_is_valid_toml(page: str, fenced: Fenced) -> None:
    assert tomllib.loads(fenced(page, "toml")[0])["hardware"] == "simulated"


def test_the_hardware_file_of_the_example_is_valid(root: Path) -> None:
    assert hardware_settings(str(root / "examples" / "two_bodies" / "robot.toml")).hardware == "simulated"
