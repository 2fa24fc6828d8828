"""A page that is opened before there is a host: it shows that it waits, and continues by itself when one comes."""

import asyncio
import contextlib
import http.client
import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from coach_gateway.access.tokens import tokens_of
from coach_gateway.settings import GatewaySettings
from coach_gateway.web.binding import PageBinding, bind_page
from coach_gateway.web.settings import WebSettings
from coach_gateway.web.waiting_page import WaitingPage
from schemas.bus.endpoint import with_free_port
from schemas.bus.zenoh.bus import open_host
from schemas.config.settings_file import write_settings
from schemas.process.clock import WallClock
from schemas.topics import SETUP
from support.messages import make_setup
from support.page_gateway import SOON, TOKENS
from support.visitor import Visitor


@contextlib.contextmanager
def waiting_page(binding: PageBinding) -> Iterator[None]:
    """It is served for as long as the block lasts."""
    stop, loop = asyncio.Event(), asyncio.new_event_loop()
    thread = threading.Thread(target=lambda: loop.run_until_complete(WaitingPage(binding, "friendly").serve(stop)))
    thread.start()
    try:
        yield
    finally:
        loop.call_soon_threadsafe(stop.set)
        thread.join(SOON)
        assert not thread.is_alive()
        loop.close()


def served(settings: GatewaySettings, folder: Path) -> subprocess.Popen[str]:
    """A gateway process that reads these settings."""
    write_settings(settings, folder / "page.json")
    command = [sys.executable, "-m", "coach_gateway", "--settings", "page.json"]
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    return subprocess.Popen(command, text=True, env=os.environ, cwd=folder, **pipes)


@pytest.fixture
def binding(tokens: Path) -> Iterator[PageBinding]:
    binding = bind_page(WebSettings(port=0), tokens_of(tokens), tokens)
    yield binding
    binding.listener.close()


def test_a_waiting_page_is_served_and_shows_that_there_is_no_host(binding: PageBinding) -> None:
    with waiting_page(binding):
        files = http.client.HTTPConnection(*binding.listener.getsockname(), timeout=SOON)
        files.request("GET", "/")
        answer = files.getresponse()
        assert answer.status == 200 and b"Touchline" in answer.read()
        assert answer.headers["Content-Security-Policy"].startswith("default-src 'none'")
        files.close()
        page = Visitor(binding.origin, TOKENS["referee"])
        welcome = page.hear("welcome")
        assert (welcome["setup"], welcome["deeds"], welcome["role"]) == (None, [], "spectator")
        assert page.hear("host")["there"] is False
        refused = page.ask("action", action={"action": "stop"})
        assert (refused["accepted"], refused["reason"]) == (False, "no host plays this match yet")
        page.send(b"garbage")
        told = [json.loads(page.socket.recv(SOON))["kind"] for _ in range(2)]
        assert told == ["alive", "alive"]
        with pytest.raises(InvalidStatus):
            Visitor(binding.origin, claims="http://evil.example")
    with pytest.raises(ConnectionClosed) as closed:
        page.hear("reply")
    assert closed.value.rcvd is not None and closed.value.rcvd.code == 1012  # come again


def test_a_waiting_page_answers_each_token(binding: PageBinding) -> None:
    with waiting_page(binding):
        page = Visitor(binding.origin)
        assert page.hear("welcome")["role"] == "spectator"
        wrong = page.ask("token", token="nonsense")
        assert not wrong["accepted"] and wrong["reason"].startswith("unknown token")
        welcome = page.enter("cyan")
        assert (welcome["role"], welcome["setup"], welcome["deeds"]) == ("cyan", None, [])
        with pytest.raises(ConnectionClosed):
            for _ in range(30):
                page.ask("token", token="a guess")


def test_the_next_server_has_the_same_address(binding: PageBinding) -> None:
    for _ in range(2):
        with waiting_page(binding):
            page = Visitor(binding.origin)
            assert page.hear("welcome")["match"] == "friendly"
            page.close()


@pytest.mark.processes
def test_a_served_page_waits_for_its_host_and_meets_it(tmp_path: Path) -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    tokens = tmp_path / "tokens.json"
    process = served(GatewaySettings(connect=endpoint, tokens=tokens, web=WebSettings(port=0)), tmp_path)
    try:
        assert process.stdout is not None
        said = [process.stdout.readline().rstrip() for _ in range(3)]
        assert said[1:] == [f"tokens: {tokens}", f"no host at {endpoint} yet; waiting for it"]
        origin = said[0].removeprefix("page: ").removesuffix("/")
        page = Visitor(origin)
        assert page.hear("welcome")["setup"] is None
        with open_host("friendly", WallClock(), endpoint) as bus:
            setups = bus.serve(SETUP)
            bus.declare_alive("host", "host")
            with pytest.raises(ConnectionClosed):
                page.hear("welcome")
            page = Visitor(origin)  # as a page does by itself
            query = setups.receive(SOON)
            assert query is not None
            query.reply(make_setup())
            page.hear_what_is_played()
            page.token = json.loads(tokens.read_text())["referee"]
            assert page.ask("token")["accepted"]
            page.close()
            process.terminate()
            rest, _ = process.communicate(timeout=SOON)
            assert (process.returncode, rest) == (0, "")
    finally:
        process.kill()
        process.communicate()


@pytest.mark.processes
def test_a_server_that_waits_for_a_host_ends_on_a_signal(tmp_path: Path) -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    process = served(GatewaySettings(connect=endpoint, web=WebSettings(port=0)), tmp_path)
    try:
        assert process.stdout is not None
        while "waiting for it" not in process.stdout.readline():
            pass
        process.terminate()
        rest, _ = process.communicate(timeout=SOON)
        assert (process.returncode, rest) == (0, "")
    finally:
        process.kill()
        process.communicate()
