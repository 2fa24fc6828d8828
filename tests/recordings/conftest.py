"""Recordings of matches on the in-process bus."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.reading.recording import Recording
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from runtime.bus.contract import Bus
from schemas.config.match_config import MatchConfig
from schemas.config.settings import RecordOptions
from schemas.soccer.game import Phase, Score
from support.in_process_bus import SharedState
from support.recorded_match import match_recorder, played
from support.recorder_rig import ONE_PART, FakeHost, RecorderRig, make_setup
from support.stepped_clock import SteppedClock

__all__ = ["match_recorder", "played"]

RigMaker = Callable[..., RecorderRig]


@pytest.fixture
def make_rig(tmp_path: Path) -> Iterator[RigMaker]:
    rigs: list[RecorderRig] = []

    def make(
        sights: bool = False,
        config: MatchConfig | None = None,
        path: Path | None = None,
        options: RecordOptions = ONE_PART,
        selection: KeySelection = EVERYTHING,
    ) -> RecorderRig:
        medium = SharedState()
        wall = SteppedClock()
        host_bus, robot_bus = medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())
        bus = medium.open_bus("friendly", wall)
        path = path or tmp_path / "match.mcap"
        path.parent.mkdir(exist_ok=True)
        sink = PartSink(path, wall, options)
        host = FakeHost(host_bus, robot_bus, make_setup())
        recorder = Recorder(bus, sink, name="recorder", sights=sights, config=config, selection=selection)
        rigs.append(RecorderRig(host, recorder, bus, sink, path))
        return rigs[-1]

    yield make
    for rig in rigs:
        rig.sink.abandon()


@pytest.fixture
def rig(make_rig: RigMaker) -> RecorderRig:
    """A recorder that knows the host's setup and has begun."""
    rig = make_rig(config=MatchConfig(seed=7))
    rig.begin()
    return rig


@pytest.fixture
def recorded(rig: RecorderRig) -> Recording:
    """A finished recording of 200 ticks with one goal."""
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(100))
    rig.host.goal(100)
    rig.play(range(100, 200))
    rig.host.referee(199, Phase.FULL_TIME, Score(cyan=1))
    rig.leave()
    return rig.read()


@pytest.fixture
def make_fake_host() -> Callable[[Bus, Bus], FakeHost]:
    """Makes a fake host on a bus of the test."""
    return lambda bus, robots: FakeHost(bus, robots, make_setup())


@pytest.fixture
def start() -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Starts Python programs, and ends those that are left."""
    running: list[subprocess.Popen[str]] = []

    def start(*arguments: str) -> subprocess.Popen[str]:
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        running.append(subprocess.Popen([sys.executable, *arguments], text=True, **pipes))
        return running[-1]

    yield start
    for process in running:
        if process.returncode is None:
            process.kill()
            process.communicate()


@pytest.fixture
def wait_until_written() -> Callable[[Any], None]:
    """Waits until the messages of a recorder are in its file."""

    def wait(rig) -> None:
        done = Event()
        rig.sink.sync()
        rig.sink._writer._hand_over(done.set)
        assert done.wait(30.0)

    return wait
