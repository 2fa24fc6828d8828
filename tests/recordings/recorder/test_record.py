"""The real thing: a recorder process at a real Zenoh host on loopback."""

import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import pytest

from recordings.container.manifest import EndReason
from recordings.editing.recovery import recover
from recordings.reading.recording import open_recording
from recordings.recorder.settings import RecorderSettings
from schemas.bus.contract import Bus
from schemas.bus.endpoint import with_free_port
from schemas.bus.zenoh.bus import open_client, open_host
from schemas.config.match_config import MatchConfig
from schemas.game import Phase, Score
from schemas.messages.world import World
from schemas.process.clock import WallClock
from schemas.topics import RECORDER_PROGRESS, STATE

LIMIT = 60.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""

TICKS = 800
"""As many as a host at full rate plays in a stall of 3 s, and a third of what it keeps."""

DYING_HOST = """
import os, sys
sys.path.insert(0, sys.argv[2])
from support.recorder_rig import FakeHost, make_setup
from schemas.bus.zenoh.bus import open_client, open_host
from schemas.process.clock import WallClock
bus = open_host("friendly", WallClock(), sys.argv[1])
robots = open_client("friendly", WallClock(), sys.argv[1])
host = FakeHost(bus, robots, make_setup())
watch = bus.watch_alive()
while (presence := watch.receive(0.01)) is None or presence.kind != "recorder":
    host.answer()
for tick in range(100):
    host.play(tick)
sys.stdin.read(1)
os.kill(os.getpid(), 9)
"""


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
def start_recorder(start, endpoint, tmp_path) -> Callable[..., subprocess.Popen[str]]:
    """Starts a recorder process that writes `match.mcap`; its settings come by standard input."""

    def start_recorder(**more: Any) -> subprocess.Popen[str]:
        recorder = start("-m", "recordings", "--settings", "-")
        settings = RecorderSettings(connect=endpoint, match="friendly", out=tmp_path / "match.mcap", **more)
        recorder.stdin.write(settings.model_dump_json())
        recorder.stdin.close()
        recorder.stdin = None
        return recorder

    return start_recorder


@pytest.fixture
def endpoint() -> str:
    return with_free_port("tcp/127.0.0.1:0")


def wait_for_recorder(bus: Bus, host=None) -> None:
    watch, deadline = bus.watch_alive(), time.monotonic() + LIMIT
    while time.monotonic() < deadline:
        if host is not None:
            host.answer()
        presence = watch.receive(0.01)
        if presence is not None and (presence.kind, presence.alive) == ("recorder", True):
            return
    raise AssertionError("the recorder never came")


@pytest.mark.processes
def test_a_recorder_process_loses_nothing_of_a_match_over_zenoh(make_fake_host, start_recorder, endpoint, tmp_path):
    recorder = start_recorder(config=MatchConfig(seed=11))
    with (
        open_host("friendly", WallClock(), endpoint) as bus,
        open_client("friendly", WallClock(), endpoint, LIMIT) as robots,
    ):
        host = make_fake_host(bus, robots)
        progress = bus.subscribe(RECORDER_PROGRESS)
        wait_for_recorder(bus, host)
        newest = -1
        for tick in range(1000):
            host.play(tick)
            while newest < tick - 250:
                report = progress.receive(LIMIT)
                assert report is not None
                newest = report.message().tick
        host.referee(999, Phase.FULL_TIME, Score(magenta=2))
        while progress.receive(LIMIT).message().messages < 6001:
            pass
    out, error = recorder.communicate(timeout=LIMIT)
    assert (recorder.returncode, error) == (0, "")
    assert "6001 messages, 1000 ticks, 0 lost" in out
    recording = open_recording(tmp_path / "match.mcap", whole=True)
    assert [World.decode(world.payload).tick for world in recording.messages("world")] == list(range(1000))
    assert recording.result.ended is EndReason.FULL_TIME
    assert recording.manifest.config.seed == 11
    assert recording.manifest.setup == host.setup
    times = [message.log_ns for message in recording.messages()]
    assert times == sorted(times)


@pytest.mark.processes
def test_a_recorder_process_finishes_its_file_on_sigterm(make_fake_host, start_recorder, endpoint, tmp_path):
    recorder = start_recorder()
    with (
        open_host("friendly", WallClock(), endpoint) as bus,
        open_client("friendly", WallClock(), endpoint, LIMIT) as robots,
    ):
        host = make_fake_host(bus, robots)
        progress = bus.subscribe(RECORDER_PROGRESS)
        wait_for_recorder(bus, host)
        for tick in range(100):
            host.play(tick)
        while progress.receive(LIMIT).message().tick < 99:
            pass
        recorder.send_signal(signal.SIGTERM)
        recorder.communicate(timeout=LIMIT)
    assert recorder.returncode == 0
    recording = open_recording(tmp_path / "match.mcap", whole=True)
    assert recording.result.ended is EndReason.STOPPED
    assert len(list(recording.messages("world"))) == 100


@pytest.mark.processes
def test_a_recorder_process_finishes_its_file_when_the_host_is_killed(start, start_recorder, endpoint, tmp_path):
    host = start("-c", DYING_HOST, endpoint, str(Path(__file__).parents[2]))
    recorder = start_recorder()
    with open_client("friendly", WallClock(), endpoint, LIMIT) as watcher:
        progress = watcher.subscribe(RECORDER_PROGRESS)
        while progress.receive(LIMIT).message().messages < 600:
            pass
    host.communicate("x", timeout=LIMIT)
    _, error = recorder.communicate(timeout=LIMIT)
    assert (recorder.returncode, error) == (0, "")
    recording = open_recording(tmp_path / "match.mcap", whole=True)
    assert recording.result.ended is EndReason.HOST_GONE
    assert recording.result.keys["world"].messages == 100


@pytest.mark.processes
def test_a_recorder_that_stood_still_for_three_seconds_at_full_rate_has_lost_nothing(
    make_fake_host, start_recorder, endpoint, tmp_path
):
    """Its link breaks after 2 s; the host goes on meanwhile, and robots too, whose commands come only once."""
    recorder = start_recorder()
    with (
        open_host("friendly", WallClock(), endpoint) as bus,
        open_client("friendly", WallClock(), endpoint, LIMIT) as robots,
    ):
        host = make_fake_host(bus, robots)
        host.is_prompt = False
        progress = bus.subscribe(RECORDER_PROGRESS)
        wait_for_recorder(bus, host)
        ticks = iter(range(TICKS))
        for phase, share, seconds in ((None, 0.1, 0.5), (signal.SIGSTOP, 0.8, 3.0), (signal.SIGCONT, 0.1, 0.5)):
            if phase is not None:
                recorder.send_signal(phase)
            for tick in islice(ticks, round(share * TICKS)):
                host.play(tick)
                time.sleep(seconds / (share * TICKS))
        host.referee(TICKS - 1, Phase.FULL_TIME, Score())
        while progress.receive(LIMIT).message().messages < 6 * TICKS + 1:
            host.relay(TICKS - 1)  # publishes, and gives missing batches again, as a host does that waits
            host.answer()
    recorder.communicate(timeout=LIMIT)
    recording = open_recording(tmp_path / "match.mcap", whole=True)
    assert (recording.result.lost, recording.result.ended) == (0, EndReason.FULL_TIME)
    counts = {key: count.messages for key, count in recording.result.keys.items() if key != STATE.key}
    assert counts == dict.fromkeys(counts, TICKS)
    assert len(counts) == 6
    times = [message.log_ns for message in recording.messages("world")]
    assert times == [number * 20_000_000 for number in range(TICKS)]


@pytest.mark.processes
def test_a_full_disk_ends_only_the_recorder_with_an_error_of_one_line(
    make_fake_host, start_recorder, endpoint, tmp_path
):
    recorder = start_recorder()
    resource.prlimit(recorder.pid, resource.RLIMIT_FSIZE, (150_000, 150_000))  # what a full disk does, by size
    with (
        open_host("friendly", WallClock(), endpoint) as bus,
        open_client("friendly", WallClock(), endpoint, LIMIT) as robots,
    ):
        host = make_fake_host(bus, robots)
        wait_for_recorder(bus, host)
        tick, deadline = 0, time.monotonic() + LIMIT
        while recorder.poll() is None and time.monotonic() < deadline:
            host.play(tick)
            tick += 1
        for more in range(tick, tick + 50):
            host.play(more)
    _, error = recorder.communicate(timeout=LIMIT)
    assert recorder.returncode == 2
    assert error.count("\n") == 1
    assert "match.mcap: File too large; what was written before is readable" in error
    done = recover(tmp_path / "match.mcap")
    assert done.messages > 0
    ticks = [world.tick for _, world in open_recording(done.path).decoded("world")]
    assert ticks == list(range(len(ticks)))


@pytest.mark.processes
def test_without_a_host_the_recorder_names_the_remedy_and_leaves_no_file(start_recorder, tmp_path):
    recorder = start_recorder(patience=0)
    _, error = recorder.communicate(timeout=LIMIT)
    assert recorder.returncode == 2
    assert error.count("\n") == 1
    assert "no host answers there" in error
    assert list(tmp_path.iterdir()) == []
