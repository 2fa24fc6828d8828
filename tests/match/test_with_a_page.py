"""Matches and replays of real processes with a page: it is announced, served, lives on, and leaves nothing behind."""

import json
import os
import re
import signal
import socket
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidHandshake

from runtime.bus.endpoint import with_free_port
from support.brisk import BRISK
from support.process_story import LIMIT, Program, wait_for
from support.visitor import Visitor

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

TEAMS = """
[teams.cyan]
brain = "robot_agent.teams.simple:Simple"
size = 1
[teams.magenta]
brain = "robot_agent.teams.simple:Simple"
size = 1
"""


@contextmanager
def page_at(address: str) -> Iterator[Visitor]:
    """A page opened at the printed address; like any page it reconnects when it is disconnected."""
    origin, _, token = address.partition("/#token=")

    def opened() -> Visitor | None:
        with suppress(OSError, InvalidHandshake, ConnectionClosed):
            page = Visitor(origin, token, patience=LIMIT)
            page.hear_what_is_played()
            return page
        return None

    page: Visitor = wait_for(opened, "a page at its address")
    try:
        yield page
    finally:
        page.close()


def ask_until_accepted(page: Visitor, action: dict[str, str]) -> None:
    """Ask for an action again until it is accepted, as a person does who waits for the ball to lie, or for a half."""
    wait_for(lambda: page.ask("action", action=action)["accepted"], str(action))


def said_address(program: Program) -> str:
    """The address of the referee's page that a program prints."""
    address = r"(http://127\.0\.0\.1:\d+/#token=\S+)"
    found = wait_for(
        lambda: re.search(address, program.out + program.err) or program.popen.poll() is not None, "an address"
    )
    assert found is not True, program.err
    return str(found[1])


def is_served(address: str) -> bool:
    port = int(address.split(":")[2].split("/")[0])
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def fetched(address: str, path: str = "") -> str:
    """A file of the page's server."""
    origin = address.partition("#")[0]
    with urllib.request.urlopen(f"{origin}{path}", timeout=LIMIT) as answer:
        return str(answer.read().decode())


@pytest.fixture
def config(tmp_path: Path) -> Path:
    file = tmp_path / "small.toml"
    file.write_text(f'name = "small"\nseed = 5\nduration = 600.0\n{TEAMS}')
    return file


def test_a_match_with_a_page_prints_its_address_survives_a_crash_of_the_server_and_leaves_no_process(
    start: Callable[..., Any], config: Path, tmp_path: Path, is_running: Callable[[int], bool]
) -> None:
    match = start(
        *("touchline", "match", str(config), "--web", "--web-port", "0", "--listen", with_free_port("tcp/127.0.0.1:0")),
        folder=tmp_path,
    )
    address = said_address(match)
    with page_at(address) as page:
        page.hear("frame")
        assert page.ask("token")["accepted"]
        assert page.hear("welcome", role="referee")["setup"]["pace"] == "realtime"
        ask_until_accepted(page, {"action": "stop"})
        server = match.process("page")
        os.kill(server, signal.SIGKILL)
        with pytest.raises(ConnectionClosed):
            page.hear("nothing")
    with page_at(address) as page:
        texts = []
        while not any("STOP" in text for text in texts):
            texts.append(page.hear("event")["event"]["text"])
        page.ask("action", action={"action": "start"})
        page.hear("frame")
    processes = list(match.processes().values())
    assert len(processes) == 5
    match.popen.send_signal(signal.SIGINT)
    assert match.status() == 130
    assert [pid for pid in processes if is_running(pid)] == []
    assert not is_served(address)
    (tokens,) = tmp_path.glob("runs/*/tokens.json")
    assert tokens.stat().st_mode & 0o077 == 0
    logs = "".join(log.read_text() for log in tmp_path.glob("runs/*/*.log"))
    assert not any(token in logs for token in json.loads(tokens.read_text()).values())


def test_a_page_that_is_served_apart_outlives_the_host_and_meets_the_next_one(
    start: Callable[..., Any], config: Path, tmp_path: Path
) -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    meeting = ("--connect", endpoint, "--match", "small")
    server = start("touchline", "coach", "serve", "--port", "0", *meeting, folder=tmp_path, name="server")
    address = said_address(server)
    host_words = ("touchline", "host", str(config), "--listen", endpoint, "--pace", "realtime")
    first = start(*host_words, folder=tmp_path, name="first")
    with page_at(address) as page:
        page.hear("host", there=True)
        page.hear("health")
        first.popen.kill()
        page.hear("host", there=False)
        gone = page.ask("action", action={"action": "stop"})
        assert (gone["accepted"], gone["reason"]) == (False, "the host is gone; wait until it is back")
        start(*host_words, folder=tmp_path, name="second")
        page.hear("host", there=True)
        page.hear("welcome")
        page.hear("health")
    server.popen.send_signal(signal.SIGTERM)
    assert server.status() == 0
    assert server.err == ""


def test_a_replay_with_a_page_is_sought_and_paused_from_it_and_leaves_nothing(
    start: Callable[..., Any], config: Path, tmp_path: Path, is_running: Callable[[int], bool]
) -> None:
    recording = tmp_path / "small.mcap"
    words = ("--duration", "4", "--rules", str(BRISK), "--record", str(recording))
    free = ("--listen", with_free_port("tcp/127.0.0.1:0"))
    assert start("touchline", "match", str(config), *words, *free, folder=tmp_path).status() == 0
    replay = start(
        *(
            "touchline",
            "replay",
            str(recording),
            "--web",
            "--web-port",
            "0",
            "--listen",
            with_free_port("tcp/127.0.0.1:0"),
        ),
        folder=tmp_path,
        name="replay",
    )
    address = said_address(replay)
    with page_at(address) as page:
        assert (page.welcome["live"], page.welcome["setup"]["match"]) == (False, "small")
        events = [page.hear("event")["event"]]
        while events[-1]["kind"] != "full_time":
            events.append(page.hear("event")["event"])
        assert page.ask("replay", request={"operation": "pause"})["accepted"]
        sought = page.ask("replay", request={"operation": "seek", "to": "2.5"})
        assert sought["answer"]["time"] == pytest.approx(2.5, abs=0.05)
        while page.hear("frame")["time"] != pytest.approx(2.5, abs=0.05):
            pass
        refused = page.ask("action", action={"action": "stop"})
        assert (refused["accepted"], refused["reason"][:16]) == (False, "this is a replay")
        processes = list(replay.processes().values())
        replay.popen.send_signal(signal.SIGINT)
    assert replay.status() == 130
    assert [pid for pid in processes if is_running(pid)] == []
    assert not is_served(address)


NO_WEB = """
from importlib.machinery import PathFinder
find = PathFinder.find_spec
gone = ("starlette", "uvicorn", "websockets")
PathFinder.find_spec = lambda name, *more: None if name.partition(".")[0] in gone else find(name, *more)
"""
"""As `sitecustomize`, makes the packages of the extra `coach` such as are not installed."""


def test_without_the_extra_a_page_is_refused_with_the_remedy_and_other_commands_work(
    start: Callable[..., Any], config: Path, tmp_path: Path
) -> None:
    (tmp_path / "sitecustomize.py").write_text(NO_WEB)
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    free = ("--listen", with_free_port("tcp/127.0.0.1:0"))
    for number, words in enumerate((("match", "--web", *free), ("coach", "serve"))):
        program = start("touchline", *words, folder=tmp_path, name=f"without{number}", PYTHONPATH=path)
        assert program.status() == 2
        needs = "the page needs starlette, uvicorn and websockets; pip install 'touchline[coach]'"
        assert program.err == f"touchline: {needs}\n"
    other = start("touchline", "credentials", "new", folder=tmp_path, name="other", PYTHONPATH=path)
    assert other.status() == 0, other.err


def test_a_person_runs_a_whole_match_from_the_page(start: Callable[..., Any], config: Path, tmp_path: Path) -> None:
    words = ("--referee", "manual", "--web", "--web-port", "0", "--listen", with_free_port("tcp/127.0.0.1:0"), "--json")
    match = start("touchline", "match", str(config), *words, folder=tmp_path)
    address = said_address(match)
    assert "<title>" in fetched(address)  # at once: it is served when it is printed
    with page_at(address) as page:
        page.hear("frame")
        for action in (
            {"action": "kick_off", "side": "cyan"},
            {"action": "start"},
            {"action": "stop"},
            {"action": "goal", "side": "cyan", "robot": "cyan1"},
            {"action": "start"},
            {"action": "end_half"},
            {"action": "kick_off", "side": "magenta"},
            {"action": "start"},
            {"action": "end_game"},
        ):
            ask_until_accepted(page, action)
        kept = page.hear("result")
        assert "--web" in kept["replay"] and kept["statistics"] is None  # they take a while
        kept = page.hear("result")
        assert ["goals", "1", "0"] in kept["figures"]
        assert 'id="match">{"title":' in fetched(address, kept["statistics"])
        assert match.popen.poll() is None  # the page is still open
    assert match.status() == 0
    result = json.loads(match.out)
    assert result["score"] == {"cyan": 1, "magenta": 0}
