"""The port of a page: bound once by the launcher, and inherited by the program that serves the page."""

import socket
import sys
import time
from pathlib import Path

import pytest

from coach_gateway.web.settings import WebSettings
from schemas.errors import TouchlineError
from touchline.launch.page import Page, open_page
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.process_table import Process, ProcessKind

SERVES = """
from coach_gateway.ports import InheritedSockets
listener = InheritedSockets().next()
listener.settimeout(60)
connection, _ = listener.accept()
connection.sendall(b"served")
"""


@pytest.fixture
def page():
    page: Page = open_page(WebSettings(port=0))
    yield page
    page.listener.close()


def test_the_port_of_a_page_is_the_page_s_from_the_moment_that_it_is_chosen(page: Page) -> None:
    assert page.settings.port == page.listener.getsockname()[1]
    with pytest.raises(
        TouchlineError, match=f"the page's port {page.settings.port} cannot be listened on at 127.0.0.1"
    ):
        open_page(WebSettings(port=page.settings.port))


@pytest.mark.processes
def test_a_browser_that_comes_before_the_program_is_served_also_by_one_that_is_started_again(
    page: Page, tmp_path: Path
) -> None:
    process = Process("page", ProcessKind.PAGE, (sys.executable, "-c", SERVES), {}, sockets=(page.listener,))
    for _ in range(2):
        with socket.create_connection(("127.0.0.1", page.settings.port), timeout=60) as browser:
            program = ChildProcess(process, tmp_path)
            assert browser.recv(100) == b"served", program.last_lines()
        while program.status() is None:
            time.sleep(0.01)
