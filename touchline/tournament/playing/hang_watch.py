"""Ends a process whose robot takes too long for one decision, and reports which robot, with its stack."""

import faulthandler
import os
import tempfile
import threading
from collections.abc import Callable
from dataclasses import dataclass

_LOOK_S = 0.25
"""Wall time between two looks."""


@dataclass(frozen=True, slots=True)
class Acting:
    """What the process does, equal as long as it does the same."""

    robot: str | None
    """The robot that decides or is built; None for the simulation."""
    tick: int
    """-1 while robots are built."""


class HangWatch:
    """A thread that looks at what the main thread does; it ends the process when a robot holds it up."""

    def __init__(self, patience: float, acting: Callable[[], Acting], report: Callable[[Acting, str], None]) -> None:
        """`patience` is wall time in s; `report` receives the robot and the stack, before the process ends."""
        self._patience = patience
        self._acting = acting
        self._report = report
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Look no more."""
        self._stop.set()
        self._thread.join()

    def _watch(self) -> None:
        before, same = self._acting(), 0.0
        while not self._stop.wait(_LOOK_S):
            now = self._acting()
            same = same + _LOOK_S if now == before and now.robot is not None else 0.0
            before = now
            if same >= self._patience:
                self._report(now, _stacks())
                os._exit(0)


def _stacks() -> str:
    """What all threads of this process do."""
    with tempfile.TemporaryFile("w+") as file:
        faulthandler.dump_traceback(file, all_threads=True)
        file.seek(0)
        return file.read()
