"""Display of a running match: one live line on a terminal, otherwise plain lines."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

from rich.live import Live
from rich.text import Text

from runtime.process.clock import Clock
from touchline.launch.terminal.console import console
from touchline.timing import REFRESH_S, STATUS_S


class Screen:
    """Shows a match in lines, for logs and pipes."""

    def __init__(self, stream: TextIO, clock: Clock) -> None:
        self._stream = stream
        self._clock = clock
        self._shown_at: float = -STATUS_S

    def status(self, line: str) -> None:
        """Print at most one line in `STATUS_S` seconds."""
        now = self._clock.now()
        if now - self._shown_at >= STATUS_S:
            self._shown_at = now
            self._write(line)

    def renew(self) -> None:
        """Have the next status printed immediately: it is of another kind than those before."""
        self._shown_at = -STATUS_S

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


class LiveScreen(Screen):
    """One line that is rewritten in place; goals and warnings scroll above it."""

    def __init__(self, stream: TextIO, clock: Clock, live: Live) -> None:
        super().__init__(stream, clock)
        self._live = live

    def status(self, line: str) -> None:
        """Rewrite the line."""
        now = self._clock.now()
        if now - self._shown_at >= REFRESH_S:
            self._shown_at = now
            self._live.update(Text(line, no_wrap=True, overflow="ellipsis"), refresh=True)

    def event(self, line: str, *, notable: bool) -> None:
        """Print the highlighted events; the line itself shows the others."""
        if notable:
            self._live.console.print(Text(line))

    def warn(self, line: str) -> None:
        """Print above the line, in yellow."""
        self._live.console.print(Text(line, style="yellow"))


@contextmanager
def screen_for(stream: TextIO, clock: Clock) -> Iterator[Screen]:
    """Yields the screen for a stream."""
    if not stream.isatty():
        yield Screen(stream, clock)
        return
    with Live(console=console(stream), auto_refresh=False, transient=True) as live:
        yield LiveScreen(stream, clock, live)
