"""A gateway that is started before its host: it waits, and its page goes on by itself when the host comes."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from coach_gateway.settings import GatewaySettings
from coach_gateway.web.settings import WebSettings
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from runtime.process.settings_file import write_settings
from schemas.topics import SETUP
from support.messages import make_setup
from support.page_gateway import SOON
from support.visitor import Visitor

pytestmark = pytest.mark.processes


@pytest.fixture
def endpoint() -> str:
    return with_free_port("tcp/127.0.0.1:0")


@pytest.fixture
def process(tmp_path: Path, endpoint: str) -> Iterator[subprocess.Popen[str]]:
    """A gateway process with a page."""
    settings = GatewaySettings(connect=endpoint, tokens=tmp_path / "tokens.json", web=WebSettings(port=0))
    write_settings(settings, tmp_path / "page.json")
    process = subprocess.Popen(
        [sys.executable, "-m", "coach_gateway", "--settings", "page.json"],
        text=True,
        env=os.environ,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    yield process
    process.kill()
    process.communicate()


def first_lines(process: subprocess.Popen[str]) -> list[str]:
    assert process.stdout is not None
    return [process.stdout.readline().rstrip() for _ in range(3)]


def end(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Its exit status after SIGTERM, and the rest of what it has said."""
    process.terminate()
    rest, _ = process.communicate(timeout=SOON)
    return process.returncode, rest


def test_a_served_page_waits_for_its_host_and_meets_it(
    process: subprocess.Popen[str], endpoint: str, tmp_path: Path
) -> None:
    page_line, *others = first_lines(process)
    assert others == [f"tokens: {tmp_path / 'tokens.json'}", f"no host at {endpoint} yet; waiting for it"]
    page = Visitor(page_line.removeprefix("page: ").removesuffix("/"))
    assert page.hear("welcome")["setup"] is None
    with open_host("friendly", WallClock(), endpoint) as bus:
        setups = bus.serve(SETUP)
        bus.declare_alive("host", "host")
        query = setups.receive(SOON)
        assert query is not None
        query.reply(make_setup())
        page.hear_what_is_played()
        page.token = json.loads((tmp_path / "tokens.json").read_text())["referee"]
        assert page.ask("token")["accepted"]
        page.close()
        assert end(process) == (0, "")
