"""Matches whose robots try what their confinement forbids: brains in a folder of their own, in real processes."""

import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from support.brisk import BRISK

_PATIENCE_S = 240.0
HEAD = """
import os, signal, sys, threading, time
from pathlib import Path
from touchline import Command

class Quiet:
    def __init__(self, briefing):
        self.robot = briefing.robot

    def act(self, sight):
        if sight.tick == 5:
            self.begin()
        return Command(answers_tick=sight.tick)

    def begin(self):
        pass
"""
"""The beginning of a module of brains; a brain's `begin` is called once, in the match."""
MATCH = """
duration = 4.0
rules = "{rules}"
{top}
[teams.cyan]
name = "Cyan"
brain = "cyan_team:Brain"
size = {size}
{cyan}
[teams.magenta]
name = "Magenta"
brain = "magenta_team:Quiet"
size = 1
[limits]
{limits}
[patience]
answer = 60.0
"""


class IsolatedMatch:
    """One match of a brain of cyan, `Brain`, against a robot that rests."""

    def __init__(
        self, folder: Path, brain: str, *, top: str = "", cyan: str = "", limits: str = "", size: int = 1
    ) -> None:
        self.folder = folder
        (folder / "cyan_team.py").write_text(f"{HEAD}\nclass Brain(Quiet):\n{brain}\n")
        (folder / "magenta_team.py").write_text(HEAD)
        (folder / "match.toml").write_text(MATCH.format(rules=BRISK, top=top, cyan=cyan, limits=limits, size=size))

    def play(self, *options: str, **environment: str) -> "PlayedMatch":
        """Play it to its end."""
        command = [sys.executable, "-m", "touchline", "match", "match.toml", "--no-record", *options]
        played = subprocess.run(
            [*command, "--listen", "tcp/127.0.0.1:0"],
            cwd=self.folder,
            env={**os.environ, **environment},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=_PATIENCE_S,
            check=False,
        )
        return PlayedMatch(self.folder, played.returncode, played.stdout)


class PlayedMatch:
    """What a match has printed and left."""

    def __init__(self, folder: Path, status: int, printed: str) -> None:
        self._folder = folder
        self.status = status
        self.printed = printed

    @property
    def run(self) -> Path:
        """Its folder under `runs/`."""
        (run,) = (self._folder / "runs").iterdir()
        return run

    def log(self, robot: str) -> str:
        return (self.run / f"{robot}.log").read_text()

    def line(self, words: str) -> str:
        """The first printed line with these words."""
        found = [line for line in self.printed.splitlines() if words in line]
        assert found, f"{words!r} in {self.printed}"
        return found[0]

    def is_whole(self) -> bool:
        """Whether it was played to its end, with a result."""
        return self.status == 0 and "full time" in self.printed


@cache
def needs_bubblewrap() -> pytest.MarkDecorator:
    """Skips where bwrap is missing, or the kernel forbids what it needs."""
    probe = ["bwrap", "--ro-bind", "/", "/", "--unshare-pid", "--proc", "/proc", "--dev", "/dev", "true"]
    missing = shutil.which("bwrap") is None
    reason = "bubblewrap is not installed" if missing else "the kernel forbids the namespaces of bubblewrap"
    works = not missing and subprocess.run(probe, capture_output=True, check=False).returncode == 0
    return pytest.mark.skipif(not works, reason=reason)
