"""Matches of one robot a side that last half a second, and brains that misbehave."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from schemas.config.match_config import MatchConfig, load_match
from support.brisk import BRISK

BRAINS = '''"""Brains for tests of plans."""

import os
import signal
import time

from touchline import Command, Drive


class Still:
    def __init__(self, briefing):
        self.briefing = briefing

    def act(self, sight):
        return Command(answers_tick=sight.tick)


class Forward(Still):
    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), dribble=True)


class Raises(Still):
    def act(self, sight):
        if sight.tick == 10:
            raise ValueError("no idea")
        return super().act(sight)


class Breaks(Still):
    def act(self, sight):
        breakpoint()
        return super().act(sight)


class CatchesAll(Still):
    def act(self, sight):
        while sight.tick == 10:
            try:
                time.sleep(60.0)
            except BaseException:
                pass
        return super().act(sight)


class HoldsTheLock(Still):
    def act(self, sight):
        if sight.tick == 10:
            sum(range(10**13))  # takes ages in C, without releasing the interpreter's lock
        return super().act(sight)


class HangsAtFirst(Still):
    def __init__(self, briefing):
        time.sleep(60.0)


class IsTerminated(Still):
    def act(self, sight):
        os.kill(os.getpid(), signal.SIGTERM)


class Dies(Still):
    def act(self, sight):
        os._exit(0)


class NotBuilt(Still):
    def __init__(self, briefing):
        raise RuntimeError("no plan")
'''


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the brains."""
    folder = tmp_path_factory.mktemp("brains")
    (folder / "planned_brains.py").write_text(BRAINS)
    return folder


@pytest.fixture(scope="session")
def match_of(folder: Path) -> Callable[..., MatchConfig]:
    """A match between two of these brains."""

    def make(cyan: str = "Forward", magenta: str = "Still", seed: int = 1, **settings: Any) -> MatchConfig:
        teams = {
            f"teams.{side}.{key}": value
            for side, name in (("cyan", cyan), ("magenta", magenta))
            for key, value in {"brain": f"planned_brains:{name}", "name": name, "size": 1}.items()
        }
        short = {"duration": 0.5, "seed": seed, "rules": str(BRISK)}
        return load_match(None, {**short, **teams, **settings})

    return make
