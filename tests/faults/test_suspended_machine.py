"""A match of `touchline match --web` whose machine is suspended."""

import os
import re
import signal
import time
from contextlib import suppress
from pathlib import Path

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


def test_match_page_and_recorder_go_on_after_the_machine_was_suspended(
    tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    (tmp_path / "cup.toml").write_text(CUP)
    words = ["--web", "--web-port", "0", "--pace", "realtime", "--listen", "tcp/127.0.0.1:0", "--record", "m.mcap"]
    environment = {"XDG_RUNTIME_DIR": str(tmp_path), "COLUMNS": "200"}
    program = Program(["touchline", "match", "cup.toml", *words, "--json"], tmp_path, "match", environment)
    request.addfinalizer(program.end)
    origin = wait_for(lambda: re.search(r"http://127\.0\.0\.1:\d+", program.out + program.err), "an address")[0]
    viewer = wait_for(lambda: visit(origin), "a page at its address", SHORT_LIMIT)
    before = viewer.hear("frame")["time"]
    everything = [program.popen.pid, *descendants(program.popen.pid)]
    for number in (signal.SIGSTOP, signal.SIGCONT):
        for pid in everything:
            with suppress(ProcessLookupError):
                os.kill(pid, number)
        if number is signal.SIGSTOP:
            time.sleep(SUSPENDED_S)
    while viewer.hear("frame")["time"] < before + 1.0:
        pass
    viewer.close()
    assert {"host", "recorder", "page", "cyan1", "magenta1"} <= set(program.processes())
    program.popen.send_signal(signal.SIGINT)
    assert program.status() == 130
    recording = open_recording(tmp_path / "m.mcap", whole=True)
    ticks = [world.tick for _, world in recording.decoded("world")]
    assert ticks == list(range(len(ticks)))
    assert ticks[-1] * 0.02 >= before + 1.0
    assert recording.result is not None and recording.result.lost_batches == 0


def visit(origin: str) -> Visitor | None:
    """A page that sees the match; None until it is served."""
    with suppress(OSError, InvalidHandshake, ConnectionClosed):
        viewer = Visitor(origin)
        viewer.hear_what_is_played()
        return viewer
    return None
