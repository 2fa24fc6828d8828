"""The page of a match or a replay as a command has it served: its port is tried, its tokens made, people are told."""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from arena.child import Child
from arena.processes import TOKENS, Page, page_process
from arena.supervisor import AT_ONCE, Notice, Supervisor
from coach_gateway.web.listening import free_port, origin_of
from coach_gateway.web.settings import need_web
from coach_gateway.web.tokens import address, read_or_make
from schemas.clock import Clock


def page_port(listen: str, port: int) -> int:
    """The port to serve on.

    Raises:
        TouchlineError: it is taken, or a package is missing.
    """
    need_web()
    return free_port(listen, port)


def page_in(folder: Path, listen: str, port: int) -> Page:
    """A page whose tokens stand in this folder.

    Raises:
        TouchlineError: they cannot be written there.
    """
    tokens = folder / TOKENS
    read_or_make(tokens)
    return Page(listen, port, tokens)


def invitation(page: Page) -> list[str]:
    """What people are told: where the referee finds the page, where everybody else, and the coaches' tokens."""
    origin = origin_of(page.address, page.port)
    return [
        f"page: {address(origin, read_or_make(page.tokens).referee)}",
        f"      that is the referee's; spectators: {origin}/; the coaches' tokens: {page.tokens}",
    ]


@contextmanager
def page_beside(
    match: str, connect: str, listen: str, port: int, clock: Clock, say: Callable[[str], None]
) -> Iterator[Callable[[], list[Notice]]]:
    """Serve the page of a match for as long as the block lasts; gives what looks after it, to be called now and then.

    Its tokens last as long.
    """
    with tempfile.TemporaryDirectory(prefix="touchline-page-") as folder:
        page = page_in(Path(folder), listen, port)
        supervisor = Supervisor(
            [page_process(page, connect, match)], lambda process: Child(process, Path(folder) / "page.log"), clock
        )
        for line in invitation(page):
            say(line)
        supervisor.start()
        try:
            yield supervisor.check
        finally:
            supervisor.end(AT_ONCE)
