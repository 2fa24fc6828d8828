"""The page of a match or a replay, served for a command: checks its port, makes its tokens, formats its addresses."""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import typer

from coach_gateway.access.tokens import page_address, tokens_of
from coach_gateway.settings import GatewaySettings
from coach_gateway.web.serving.binding import listen, origin_of
from coach_gateway.web.settings import WebSettings, need_web
from runtime.access.accounts import Account
from runtime.access.credentials import account_file
from runtime.bus.endpoint import local_endpoint
from runtime.bus.zenoh.bus import ZenohBus
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.process_table import ProcessKind, library_process
from touchline.launch.processes.programs import TOKENS, Page
from touchline.launch.processes.supervisor import AT_ONCE, Notice, Supervisor


def open_page(web: WebSettings) -> Page:
    """The page with these settings, on a port that is listened on from now on.

    Raises:
        TouchlineError: the port is in use, or a package is missing.
    """
    need_web()
    listener = listen(web.listen_web, web.port)
    return Page(web.model_copy(update={"port": listener.getsockname()[1]}), listener)


def address_lines(web: WebSettings, tokens: Path) -> list[str]:
    """The lines to print: the referee's address of the page, the spectators' address, and the coaches' tokens.

    A browser that opens the page before it is served waits.

    Raises:
        TouchlineError: the tokens cannot be written to their file.
    """
    origin = origin_of(web.listen_web, web.port)
    return [
        f"page: {page_address(origin, tokens_of(tokens).referee)}",
        f"      that is the referee's; spectators: {origin}/; the coaches' tokens: {tokens}",
    ]


@contextmanager
def serve_page_beside(
    bus: ZenohBus, page: Page | None, credentials: Path | None
) -> Iterator[Callable[[], list[Notice]]]:
    """Serve the page of a replay within the block; yields a function that supervises it, to be called periodically.

    The tokens are valid within the block. `credentials` is the file of a host that has credentials.
    """
    if page is None:
        yield list
        return
    operator = account_file(credentials.parent, Account.OPERATOR) if credentials is not None else None
    with tempfile.TemporaryDirectory(prefix="touchline-page-") as name:
        folder = Path(name)
        tokens, endpoint = folder / TOKENS, local_endpoint(bus.endpoint)
        settings = GatewaySettings(
            connect=endpoint, match=bus.match, credentials=operator, tokens=tokens, web=page.settings
        )
        process = library_process("page", ProcessKind.PAGE, settings, folder, sockets=(page.listener,))
        supervisor = Supervisor([process], partial(ChildProcess, folder=folder), bus.clock)
        for line in address_lines(page.settings, tokens):
            typer.echo(line, err=True)
        supervisor.start()
        try:
            yield supervisor.check
        finally:
            supervisor.end(AT_ONCE)
