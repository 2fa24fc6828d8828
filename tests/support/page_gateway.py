"""The gateway's server of pages, in a thread of its own and on a port of loopback."""

import asyncio
import json
import threading
from contextlib import suppress
from pathlib import Path

from coach_gateway.access.tokens import tokens_of
from coach_gateway.service import together
from coach_gateway.web.serving.binding import bind_page
from coach_gateway.web.serving.server import WebServer
from coach_gateway.web.settings import WebSettings
from runtime.process.clock import WallClock
from support.in_process_bus import SharedState

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
    """The page's server in a thread of its own; without `medium` it waits for a host until `meet` is called."""

    def __init__(
        self, medium: SharedState | None, settings: WebSettings, tokens: Path | None, result: Path | None = None
    ) -> None:
        self.logged: list[str] = []
        self.binding = bind_page(settings, tokens_of(tokens), tokens)
        self.origin = self.binding.origin
        self._medium, self._result = medium, result
        self._met, self._stop = asyncio.Event(), asyncio.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._run()))
        self._ready = threading.Event()
        self._thread.start()
        assert self._ready.wait(SOON)

    async def _run(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._server = WebServer(self.binding, "friendly", self.logged.append, self._result)
        self.pages = self._server.pages
        if self._medium is not None:
            self._show(self._medium)
        self._ready.set()
        await together([self._server, self], self._stop)

    def _show(self, medium: SharedState) -> None:
        self._bus = medium.open_bus("friendly", WallClock())
        self._match = self._server.show(self._bus)
        self._met.set()

    def meet(self, medium: SharedState) -> None:
        """A host is there from now on."""
        self._loop.call_soon_threadsafe(self._show, medium)

    async def serve(self, stop: asyncio.Event) -> None:
        """Show the match as soon as there is one."""
        met, stopped = asyncio.create_task(self._met.wait()), asyncio.create_task(stop.wait())
        await asyncio.wait([met, stopped], return_when=asyncio.FIRST_COMPLETED)
        met.cancel()
        stopped.cancel()
        if self._met.is_set():
            with self._bus:
                await self._match.serve(stop)

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

    def stop(self) -> None:
        """Tell it to end, unless it has."""
        if self._thread.is_alive():
            with suppress(RuntimeError):  # it has ended meanwhile
                self._loop.call_soon_threadsafe(self._stop.set)

    def close(self) -> None:
        self.stop()
        self._thread.join(SOON)
        assert not self._thread.is_alive()
        self.binding.listener.close()
