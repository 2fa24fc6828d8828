"""The gateway's server of pages, in a thread of its own and on a port of loopback."""

import asyncio
import json
import threading
from collections.abc import Callable
from pathlib import Path

from coach_gateway.access.tokens import tokens_of
from coach_gateway.web.binding import bind_page
from coach_gateway.web.server import WebServer
from coach_gateway.web.settings import WebSettings
from coach_gateway.web.waiting_page import WaitingPage
from schemas.bus.in_process_bus import SharedState
from schemas.process.clock import WallClock

SOON = 20.0
"""Patience in s, longer than any wait here: a test fails only if something never happens."""
TOKENS = {"referee": "the-referee", "cyan": "cyans-coach", "magenta": "magentas-coach"}


def tokens_in(folder: Path) -> Path:
    """A file with `TOKENS` in this folder."""
    tokens = folder / "tokens.json"
    if not tokens.exists():
        tokens.touch(0o600)
        tokens.write_text(json.dumps(TOKENS))
    return tokens


class Gateway:
    """The page's server in a thread of its own; without `medium` it waits for a host in vain."""

    def __init__(
        self, medium: SharedState | None, settings: WebSettings, tokens: Path | None, result: Path | None = None
    ) -> None:
        self.logged: list[str] = []
        self.binding = bind_page(settings, tokens_of(tokens), tokens)
        self.origin = self.binding.origin
        self.bus = medium.open_bus("friendly", WallClock()) if medium is not None else None
        self._result = result
        self._stop = asyncio.Event()
        self._thread = threading.Thread(
            target=self._run,
        )
        self._ready = threading.Event()
        self._thread.start()
        assert self._ready.wait(SOON)

    def _run(self) -> None:
        async def main() -> None:
            self._loop = asyncio.get_running_loop()
            if self.bus is not None:
                self.server = WebServer(self.bus, self.binding, self.logged.append, self._result)
            waiting = WaitingPage(self.binding, "friendly", log=self.logged.append)
            self.pages = self.server.pages if self.bus is not None else waiting.pages
            self._ready.set()
            await (waiting if self.bus is None else self.server).serve(self._stop)

        asyncio.run(main())

    def call(self, do: Callable[[], object]) -> None:
        """Have its thread do something soon."""
        self._loop.call_soon_threadsafe(do)

    @property
    def port(self) -> int:
        return int(self.origin.rpartition(":")[2])

    @property
    def runs(self) -> bool:
        """It has not ended by itself."""
        return self._thread.is_alive()

    def wait(self) -> bool:
        """Wait until it has ended by itself; whether it has."""
        self._thread.join(SOON)
        return not self.runs

    def close(self) -> None:
        if not self._thread.is_alive():
            return
        self._loop.call_soon_threadsafe(self._stop.set)
        self._thread.join(SOON)
        assert not self._thread.is_alive()
        self.binding.listener.close()
        if self.bus is not None:
            self.bus.close()
