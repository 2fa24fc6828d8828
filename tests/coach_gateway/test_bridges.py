"""Which bridges a command's words ask for, and the gateway's process with them."""

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from coach_gateway import run, service
from coach_gateway.bridges import Bridges, bridges_of
from coach_gateway.ports import INHERITED, InheritedSockets, inheritance_of
from coach_gateway.process import say as log
from coach_gateway.settings import BridgeOptions, GatewaySettings
from coach_gateway.soccer.refbox.client import BoxAddress
from coach_gateway.soccer.refbox.server import ServerAddress
from runtime.bus.endpoint import with_free_port
from runtime.bus.settings import ClientSettings
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from runtime.process.settings_file import write_settings
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side
from schemas.soccer.game import Phase
from schemas.topics import SETUP, STATE
from support.messages import make_setup

LIMIT_S = 60.0
"""To start, a process takes a second of a core: many, where others want it, too."""


def asked(**words: Any) -> Bridges:
    return bridges_of(BridgeOptions(**words))


def test_no_words_ask_for_nothing() -> None:
    assert not BridgeOptions().wanted
    assert asked() == Bridges()


@pytest.mark.parametrize("port", [70000, -1])
def test_a_udp_port_has_its_limits(port: int) -> None:
    with pytest.raises(ValidationError, match="udp"):
        BridgeOptions(udp=port)


def test_words_are_addresses_and_doors() -> None:
    wanted = asked(
        udp=0,
        refbox="box.local",
        team=list(Side),
        refbox_server=["28097", "magenta:28098", "28099:characters", "cyan:0:characters"],
        address=["cyan=224.16.32.44"],
        audience=["127.0.0.1:12345", "[::1]:9"],
    )
    assert wanted.boxes == (BoxAddress(Side.CYAN, "box.local", 28097), BoxAddress(Side.MAGENTA, "box.local", 28097))
    assert wanted.server_addresses == (
        ServerAddress(28097),
        ServerAddress(28098, Side.MAGENTA),
        ServerAddress(28099, protocol=BoxProtocol.CHARACTERS),
        ServerAddress(0, Side.CYAN, protocol=BoxProtocol.CHARACTERS),
    )
    assert wanted.addresses == {Side.CYAN: "224.16.32.44"}
    assert wanted.audience == (("127.0.0.1", 12345), ("::1", 9))
    assert asked(refbox="10.0.0.2:9000", team=[Side.CYAN]).boxes[0].port == 9000


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"refbox": "box"}, "--refbox needs the team"),
        ({"team": [Side.CYAN]}, "--team is for --refbox"),
        ({"refbox": "box:0", "team": [Side.CYAN]}, '--refbox is "box:0"; it is HOST or HOST:PORT'),
        ({"refbox": "box:port", "team": [Side.CYAN]}, "HOST or HOST:PORT"),
        ({"audience": ["12345"]}, '--audience is "12345"; it is HOST:PORT'),
        ({"refbox_server": ["blue:28097"]}, '--refbox-server is "blue:28097"'),
        ({"refbox_server": ["99999"]}, "--refbox-server"),
        ({"refbox_server": ["-1"]}, "--refbox-server"),
        ({"refbox_server": ["28097:morse"]}, '--refbox-server is "28097:morse"; it is PORT'),
        ({"address": ["cyan=224.16.32.44"]}, "--address is for --refbox-server, which is not given"),
        ({"refbox_server": ["0"], "address": ["224.16.32.44"]}, '--address is "224.16.32.44"; it is cyan=ADDRESS'),
        ({"refbox_server": ["0"], "address": ["cyan="]}, '--address is "cyan="; it is cyan=ADDRESS'),
        ({"refbox": "box..local", "team": [Side.CYAN]}, '--refbox is "box..local"'),
        ({"refbox": "::1", "team": [Side.CYAN]}, '--refbox is "::1"'),
    ],
)
def test_invalid_options_are_errors_with_the_reason(words: dict[str, Any], says: str) -> None:
    with pytest.raises(TouchlineError, match=says.replace("(", r"\(")):
        asked(**words)


def test_a_taken_port_is_reported_before_there_is_a_host() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        with pytest.raises(
            TouchlineError, match=rf"--udp {port} cannot be listened on at 127.0.0.1 \(Address already in use\)"
        ):
            run(GatewaySettings(connect="tcp/127.0.0.1:1", bridges=BridgeOptions(udp=port)))


def test_a_port_that_is_given_twice_is_reported() -> None:
    port = with_free_port("tcp/127.0.0.1:0").rpartition(":")[2]
    with pytest.raises(TouchlineError, match=rf"--refbox-server {port} cannot be listened on"):
        asked(refbox_server=[port, f"cyan:{port}"]).open_ports()
    with asked(refbox_server=[port]).open_ports()[0] as bound:  # the first attempt has left nothing open
        assert bound.getsockname()[1] == int(port)


def test_open_ports_are_taken_over_by_the_program_that_inherits_them(monkeypatch: pytest.MonkeyPatch) -> None:
    bridges = asked(udp=0, refbox_server=["0", "cyan:0"])
    launcher = bridges.open_ports()
    copies = [one.dup() for one in launcher]
    monkeypatch.setenv(INHERITED, inheritance_of(copies)[INHERITED])
    for copy in copies:
        copy.detach()
    inherited = InheritedSockets()
    program = bridges.open_ports(inherited)
    assert [one.getsockname() for one in program] == [one.getsockname() for one in launcher]
    assert program[0].type is socket.SOCK_DGRAM
    assert inherited.next() is None
    assert INHERITED not in os.environ  # of the programs that this one starts
    for one in (*launcher, *program):
        one.close()


@pytest.mark.parametrize("address", ["192.0.2.1", "a..b"])
def test_an_address_of_another_machine_is_reported(address: str) -> None:
    with pytest.raises(TouchlineError, match=f"--listen-bridges {address} is not an address of this machine"):
        asked(udp=0, listen_bridges=address).open_ports()


def test_texts_from_the_network_cannot_control_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    log("base station 1: \x1b[2J, \ud800\n, Zoë")
    assert capsys.readouterr().out == "base station 1: \ufffd[2J, \ufffd\ufffd, Zoë\n"


def test_bridges_need_no_web_server() -> None:
    """The base installation has neither starlette nor uvicorn."""
    script = (
        "import sys; sys.modules.update(dict.fromkeys(('starlette', 'uvicorn', 'websockets')));"
        "import coach_gateway.bridges, coach_gateway.process"
    )
    assert subprocess.run([sys.executable, "-c", script], env=os.environ, check=False).returncode == 0


def test_a_gateway_that_waits_for_a_host_ends_on_a_signal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "HOST_RETRY_S", 0.1)
    endpoint, logged = with_free_port("tcp/127.0.0.1:0"), list[str]()

    def end(line: str) -> None:
        logged.append(line)
        signal.raise_signal(signal.SIGTERM)

    service.run(ClientSettings(connect=endpoint), lambda bus: [], end)
    assert logged == [f"no host at {endpoint} yet; waiting for it"]


@pytest.mark.processes
def test_one_process_has_all_bridges_and_ends_on_a_signal_with_a_bye_to_coach_programs(tmp_path: Path) -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    setup = make_setup()
    tokens = tmp_path / "tokens.json"
    bridges = BridgeOptions(udp=0, refbox_server=["0"], audience=["127.0.0.1:9"])
    write_settings(GatewaySettings(connect=endpoint, tokens=tokens, bridges=bridges), tmp_path / "bridges.json")
    command = [sys.executable, "-m", "coach_gateway", "--settings", str(tmp_path / "bridges.json")]
    with open_host("friendly", WallClock(), endpoint) as bus:
        setups, states = bus.serve(SETUP), bus.publisher(STATE)
        bus.declare_alive("host", "host")
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=os.environ)
        try:
            assert process.stdout is not None
            lines = [process.stdout.readline() for _ in range(4)]
            assert lines[0] == f"tokens: {tokens}\n"
            ports = {line.split(" on ")[0]: int(line.rsplit(":", 1)[1]) for line in lines[1:]}
            query = setups.receive(LIMIT_S)
            assert query is not None
            query.reply(setup)
            with closing(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) as program:
                program.settimeout(LIMIT_S)
                program.connect(("127.0.0.1", ports["coach programs over UDP"]))
                asyncio.run(_meet(ports, json.loads(tokens.read_text("utf-8"))["cyan"], states, program))
                process.send_signal(signal.SIGINT)
                kind = ""
                while kind != "bye":
                    kind = json.loads(program.recv(65536))["kind"]
            rest, _ = process.communicate(timeout=LIMIT_S)
            assert process.returncode == 0, rest
            assert "Traceback" not in rest
        finally:
            process.kill()
            process.communicate()


async def _meet(ports: dict[str, int], token: str, states: Any, program: socket.socket) -> None:
    """A base station receives a corner, and a coach program is welcomed."""
    reader, writer = await asyncio.open_connection("127.0.0.1", ports["referee box for base stations"])
    writer.write(json.dumps({"type": "hello", "team": "magenta"}).encode() + b"\x00")
    assert json.loads((await reader.readuntil(b"\x00"))[:-1])["command"] == "WELCOME"
    game = GameState(tick=1, time=0.02, phase=Phase.STOPPED)
    heard = ""
    for tick in range(2, 1000):
        corner = game.replace(tick=tick, phase=Phase.CORNER if tick % 2 else Phase.STOPPED)
        states.put(corner.replace(side=Side.CYAN if tick % 2 else None))
        with_it = asyncio.wait_for(reader.readuntil(b"\x00"), 0.05)
        try:
            heard += (await with_it)[:-1].decode()
        except TimeoutError:
            continue
        if "CORNER" in heard:
            break
    assert "CORNER" in heard
    writer.transport.abort()
    program.send(json.dumps({"kind": "hello", "sequence": 1, "token": token}).encode())
    assert json.loads(program.recv(65536))["role"] == "cyan"
