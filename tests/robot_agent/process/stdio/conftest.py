"""Programs of lines whose behaviour is a few lines of Python."""

import sys
from collections.abc import Callable, Iterator
from typing import TypeVar

import pytest

from robot_agent.process.stdio.program import Exchange, StdioProgram
from robot_agent.sdk.contract import Briefing
from runtime.process.clock import WallClock
from schemas.messages.sight import Sight
from support.stepped_clock import SteppedClock

HEAD = """
import json, os, signal, sys
briefing = json.loads(sys.stdin.readline())

def answer(tick, **fields):
    print(json.dumps({"answers_tick": tick, **fields}), flush=True)

"""
LIMIT_S = 60.0
T = TypeVar("T")


class Bench:
    """One program, whose clock is stepped by the test, and the lines that its agent logs."""

    def __init__(self, code: str, briefing: Briefing) -> None:
        self.clock = SteppedClock()
        self.log: list[str] = []
        command = [sys.executable, "-I", "-S", "-c", HEAD + code]
        self.program = StdioProgram(command, briefing, self.clock, self.log.append)

    def pass_time(self, seconds: float) -> None:
        self.clock.sleep_until(self.clock.now() + seconds)

    def ask(self, sight: Sight) -> Exchange:
        """One exchange that does not wait."""
        return self.program.exchange(sight, wait=0.0)

    def answered(self, sight: Sight) -> Exchange:
        """The exchange that brings the answer."""
        return self.until(lambda: found if (found := self.ask(sight)).answer is not None else None)

    def until(self, look: Callable[[], T | None]) -> T:
        """The first result that is not None."""
        deadline = WallClock().now() + LIMIT_S
        while WallClock().now() < deadline:
            found = look()
            if found is not None:
                return found
            WallClock().sleep_until(WallClock().now() + 0.005)
        raise AssertionError("it never came")


@pytest.fixture
def bench(briefing: Briefing) -> Iterator[Callable[[str], Bench]]:
    """Makes a bench for the code of a program, which has `briefing` and reads sights from standard input."""
    made: list[Bench] = []

    def make(code: str) -> Bench:
        made.append(Bench(code, briefing))
        return made[-1]

    yield make
    for one in made:
        one.program.close()
