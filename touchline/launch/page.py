"""The page of a match or a replay as a command has it served: its port is tried, its tokens made, people are told."""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from coach_gateway.access.tokens import page_address, read_or_make
from coach_gateway.web.listener import free_port, origin_of
from coach_gateway.web.settings import need_web
from schemas.process.clock import Clock
from touchline.launch.child_process import ChildProcess
from touchline.launch.processes import TOKENS, PagePlan, page_process
from touchline.launch.supervisor import AT_ONCE, Notice, Supervisor


def page_port(listen: str, port: int) -> int:
    """The port to serve on.

    Raises:
        TouchlineError: it is taken, or a package is missing.
    """
    need_web()
    return free_port(listen, port)


def page_with_tokens(folder: Path, listen: str, port: int) -> PagePlan:
    """A page whose tokens stand in this folder.

    Raises:
        TouchlineError: they cannot be written there.
    """
    tokens = folder / TOKENS
    read_or_make(tokens)
    return PagePlan(listen, port, tokens)


def address_lines(page: PagePlan) -> list[str]:
    """What people are told: where the referee finds the page, where everybody else, and the coaches' tokens."""
    origin = origin_of(page.address, page.port)
    return [
        f"page: {page_address(origin, read_or_make(page.tokens).referee)}",
        f"      that is the referee's; spectators: {origin}/; the coaches' tokens: {page.tokens}",
    ]


@contextmanager
def serve_page_beside(
    match: str, connect: str, listen: str, port: int, clock: Clock, log: Callable[[str], None]
) -> Iterator[Callable[[], list[Notice]]]:
    """Serve the page of a match for as long as the block lasts; gives what looks after it, to be called now and then.

    Its tokens last as long.
    """
    with tempfile.TemporaryDirectory(prefix="touchline-page-") as folder:
        page = page_with_tokens(Path(folder), listen, port)
        supervisor = Supervisor(
            [page_process(page, connect, match)],
            lambda process: ChildProcess(process, Path(folder) / "page.log"),
            clock,
        )
        for line in address_lines(page):
            log(line)
        supervisor.start()
        try:
            yield supervisor.check
        finally:
            supervisor.end(AT_ONCE)
