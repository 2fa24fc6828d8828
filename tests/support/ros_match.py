"""Processes of a match whose robots ROS 2 nodes drive."""

import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LIMIT_S = 200.0
TEAM = Path(__file__).parent / "ros_team.py"
"""The program of nodes that others wrote."""


@contextmanager
def started(words: list[str], folder: Path, name: str) -> Iterator[Path]:
    """A process, ended afterwards; its output is in the file."""
    log = folder / f"{name}.log"
    with log.open("w") as file:
        process = subprocess.Popen(words, cwd=folder, stdout=file, stderr=subprocess.STDOUT)
        try:
            yield log
        finally:
            process.terminate()
            process.wait(LIMIT_S)


def touchline(*words: str) -> list[str]:
    return [sys.executable, "-m", "touchline", *words]


def said_in(log: Path, pattern: str) -> str:
    """What a process has said, once it has."""
    deadline = time.monotonic() + LIMIT_S
    while (found := re.search(pattern, log.read_text())) is None:
        assert time.monotonic() < deadline, log.read_text()
        time.sleep(0.05)
    return found[1]


def graph_at(log: Path) -> str:
    """The endpoint that `touchline ros2` has said."""
    return said_in(log, r"reach this graph at (tcp/[\d.]+:\d+)")
