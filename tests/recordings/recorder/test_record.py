"""The real thing: a recorder process at a real Zenoh host on loopback."""

import subprocess
import time
from collections.abc import Callable
from typing import Any

import pytest

from recordings.container.manifest import EndReason
from recordings.reading.recording import open_recording
from recordings.recorder.settings import RecorderSettings
from runtime.bus.contract import Bus
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_client, open_host
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.messages.world import World
from schemas.soccer.game import Phase, Score
from schemas.topics import RECORDER_PROGRESS

LIMIT = 60.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""


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
def test_without_a_host_the_recorder_names_the_remedy_and_leaves_no_file(start_recorder, tmp_path):
    recorder = start_recorder(patience=0)
    _, error = recorder.communicate(timeout=LIMIT)
    assert recorder.returncode == 2
    assert error.count("\n") == 1
    assert "no host answers there" in error
    assert list(tmp_path.iterdir()) == []
