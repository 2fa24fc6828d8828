"""Display of a running match: one live line on a terminal, otherwise plain lines."""

from types import TracebackType
from typing import Self, TextIO

from rich.live import Live
from rich.text import Text

from schemas.process.clock import Clock
from touchline.cli.console import console
from touchline.timing import LINE_S, REFRESH_S


class Screen:
    """Shows a match in lines, for logs and pipes."""

    def __init__(self, stream: TextIO, clock: Clock) -> None:
        self._stream = stream
        self._clock = clock
        self._shown_at = -LINE_S

    def status(self, line: str) -> None:
        """Print at most one line in `LINE_S` seconds."""
        now = self._clock.now()
        if now - self._shown_at >= LINE_S:
            self._shown_at = now
            self._write(line)

    def event(self, line: str, *, notable: bool) -> None:
        """Print every event."""
        del notable
        self._write(line)

    def warn(self, line: str) -> None:
        """Print every warning."""
        self._write(line)

    def _write(self, line: str) -> None:
        self._stream.write(line + "\n")
        self._stream.flush()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        return None


class LiveScreen(Screen):
    """One line that is rewritten in place; goals and warnings scroll above it."""

    def __init__(self, stream: TextIO, clock: Clock) -> None:
        super().__init__(stream, clock)
        self._console = console(stream)
        self._live = Live(console=self._console, auto_refresh=False, transient=True)

    def status(self, line: str) -> None:
        """Rewrite the line."""
        now = self._clock.now()
        if now - self._shown_at >= REFRESH_S:
            self._shown_at = now
            self._live.update(Text(line, no_wrap=True, overflow="ellipsis"), refresh=True)

    def event(self, line: str, *, notable: bool) -> None:
        """Print the highlighted events; the line itself shows the others."""
        if notable:
            self._console.print(Text(line))

    def warn(self, line: str) -> None:
        """Print above the line, in yellow."""
        self._console.print(Text(line, style="yellow"))

    def __enter__(self) -> Self:
        self._live.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._live.stop()


def screen_for(stream: TextIO, clock: Clock) -> Screen:
    """The screen for a stream."""
    return LiveScreen(stream, clock) if stream.isatty() else Screen(stream, clock)
