"""Serves the pages of a cup on this machine while it runs."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from schemas.errors import TouchlineError
from touchline.matches.cup.cup_plan import LOGS

_HOST = "127.0.0.1"


class _Pages(SimpleHTTPRequestHandler):
    """Pages, recordings and logs; the database is no page."""

    def do_GET(self) -> None:
        path = PurePosixPath(unquote(self.path))
        is_log_folder = path.parts[:2] == ("/", LOGS) and not path.suffix and ".." not in path.parts
        if path.suffix in (".html", ".mcap", ".log", ".txt") or is_log_folder:
            super().do_GET()
        elif self.path == "/":
            self.path = "/index.html"
            super().do_GET()
        else:
            self.send_error(404)

    def end_headers(self) -> None:
        self.send_header("Cache-Control", "no-store")
        super().end_headers()

    def log_message(self, format: str, *args: object) -> None:
        """Log no request: stderr has the progress of the cup."""


@contextmanager
def served(folder: Path, port: int) -> Iterator[str]:
    """Serve the folder; yields the address of its first page.

    Raises:
        TouchlineError: the port is in use.
    """
    try:
        server = ThreadingHTTPServer((_HOST, port), partial(_Pages, directory=str(folder)))
    except OSError as error:
        raise TouchlineError(f"--port is {port}: {error.strerror}; give another one, or 0 for a free one") from None
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://{_HOST}:{server.server_address[1]}/index.html"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
