"""SIGINT and SIGTERM of a command that supervises processes: stored, so that it ends them in order."""

import signal
from types import FrameType, TracebackType
from typing import Self


class StopSignals:
    """Within the block SIGINT and SIGTERM are stored instead of raised."""

    def __init__(self) -> None:
        self.received: int | None = None
        self._before: dict[int, object] = {}

    def __enter__(self) -> Self:
        for number in (signal.SIGINT, signal.SIGTERM):
            self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)  # type: ignore[arg-type]

    def _note(self, number: int, frame: FrameType | None) -> None:
        del frame
        self.received = self.received or number
