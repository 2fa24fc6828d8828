"""A match of `touchline match --web` whose page and recorder are killed, and whose machine is suspended."""

import os
import re
import signal
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidHandshake

from recordings.reading.recording import open_recording
from support.process_story import SHORT_LIMIT, Program, descendants, wait_for
from support.visitor import Visitor

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

SUSPENDED_S = 3.0
"""Wall time for which all processes stand still."""
CUP = """
name = "small"
duration = 600
[teams.cyan]
size = 1
[teams.magenta]
size = 1
"""


class WatchedMatch:
    """A match in real time, and a viewer that reconnects as a browser does."""

    def __init__(self, folder: Path) -> None:
        (folder / "cup.toml").write_text(CUP)
        words = (
            "--web",
            "--web-port",
            "0",
            "--pace",
            "realtime",
            "--listen",
            "tcp/127.0.0.1:0",
            "--record",
            "m.mcap",
            "--json",
        )
        environment = {"XDG_RUNTIME_DIR": str(folder), "COLUMNS": "200"}
        self.folder = folder
        self.program = Program(["touchline", "match", "cup.toml", *words], folder, "match", environment)
        found = wait_for(
            lambda: re.search(r"http://127\.0\.0\.1:\d+", self.program.out + self.program.err), "an address"
        )
        self.origin = found[0]
        self.viewer = self._visit()
        self.time = self.newest_time()

    def newest_time(self) -> float:
        """Simulated time of the next frame that the viewer is sent."""
        frame: dict[str, Any] = self.viewer.hear("frame")
        return float(frame["time"])

    def until_time(self, time_s: float) -> None:
        """Watch until this simulated time; the viewer reconnects when it is disconnected."""
        deadline = time.monotonic() + SHORT_LIMIT
        while self.time < time_s:
            assert time.monotonic() < deadline, self.program.err
            try:
                self.time = self.newest_time()
            except ConnectionClosed:
                self.viewer = self._visit()

    def kill(self, name: str) -> None:
        os.kill(self.program.process(name), signal.SIGKILL)

    def _visit(self) -> Visitor:
        def opened() -> Visitor | None:
            with suppress(OSError, InvalidHandshake, ConnectionClosed):
                viewer = Visitor(self.origin)
                viewer.hear_what_is_played()
                return viewer
            return None

        visitor: Visitor = wait_for(opened, "a page at its address", SHORT_LIMIT)
        return visitor


@pytest.fixture(scope="module")
def match(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WatchedMatch]:
    watched = WatchedMatch(tmp_path_factory.mktemp("watched"))
    yield watched
    watched.program.end()


def test_a_killed_page_is_back_on_its_port_and_its_viewer_sees_the_match_go_on(match: WatchedMatch) -> None:
    before = match.program.process("page")
    match.kill("page")
    with pytest.raises(ConnectionClosed):
        match.viewer.hear("nothing")
    match.until_time(match.time + 1.0)
    assert match.program.process("page") != before
    assert "page was ended by SIGKILL; started again (1 of 3)" in match.program.err


def test_a_killed_recorder_is_replaced_while_the_match_goes_on(match: WatchedMatch) -> None:
    match.kill("recorder")
    match.program.wait_for_error("recorder was ended by SIGKILL; started again (1 of 3)")
    part = match.folder / "m.2.mcap"
    wait_for(lambda: part.exists() and part.stat().st_size, "the next part of the recording", SHORT_LIMIT)
    match.until_time(match.time + 1.0)


def test_match_page_and_recorder_go_on_after_the_machine_was_suspended(match: WatchedMatch) -> None:
    everything = [match.program.popen.pid, *descendants(match.program.popen.pid)]
    for number in (signal.SIGSTOP, signal.SIGCONT):
        for pid in everything:
            with suppress(ProcessLookupError):
                os.kill(pid, number)
        if number is signal.SIGSTOP:
            time.sleep(SUSPENDED_S)
    match.until_time(match.time + 1.0)
    assert {"host", "recorder", "page", "cyan1", "magenta1"} <= set(match.program.processes())


def test_the_recording_of_all_this_is_whole(match: WatchedMatch) -> None:
    match.viewer.close()
    match.program.popen.send_signal(signal.SIGINT)
    assert match.program.status() == 130
    recording = open_recording(match.folder / "m.mcap", whole=True)
    ticks = [world.tick for _, world in recording.decoded("world")]
    assert ticks == list(range(len(ticks)))
    assert ticks[-1] * 0.02 >= match.time
    assert recording.result is not None and recording.result.lost_batches == 0
