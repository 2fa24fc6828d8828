"""A match in lockstep on a machine that is busy otherwise: it lasts longer, and nothing else."""

import json
import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from support.brisk import BRISK

pytestmark = [pytest.mark.processes, pytest.mark.long, pytest.mark.alone, pytest.mark.timeout(300)]

LOAD = 20
"""Processes that compute all the time, on one core with all of the match."""
PATIENCE_S = 280.0
MATCH = f"""
name = "busy"
duration = 1
rules = "{BRISK}"

[teams.cyan]
size = 1

[teams.magenta]
size = 1
"""


@contextmanager
def load() -> Iterator[None]:
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(cores)})  # which all processes that are started from now on inherit
    busy = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(LOAD)]
    try:
        yield
    finally:
        os.sched_setaffinity(0, cores)
        for one in busy:
            one.kill()
            one.wait()


def chain(start, folder: Path) -> str:
    folder.mkdir()
    (folder / "match.toml").write_text(MATCH)
    words = ("--seed", "4", "--record", "m.mcap", "--json", "--listen", "tcp/127.0.0.1:0")
    program = start("touchline", "match", "match.toml", *words, folder=folder)
    assert program.popen.wait(PATIENCE_S) == 0, program.err
    program.status()
    assert json.loads(program.out)["missed"] == {}
    recording = open_recording(folder / "m.mcap", whole=True)
    assert recording.result.lost == 0
    return [applied.chain for _, applied in recording.decoded("host/applied")][-1]


def test_one_seed_gives_one_match_alone_and_beside_twenty_busy_processes(start, tmp_path) -> None:
    alone = chain(start, tmp_path / "alone")
    with load():
        busy = chain(start, tmp_path / "busy")
    assert busy == alone
