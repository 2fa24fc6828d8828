"""Our referee as a referee box: small base stations, written from the protocol's tables, over real sockets."""

import asyncio
import json
import socket
from collections.abc import Callable
from contextlib import asynccontextmanager
from typing import Any

import pytest

from coach_gateway.soccer.refbox import server as server_module
from coach_gateway.soccer.refbox.audience_feed import AudienceFeed
from coach_gateway.soccer.refbox.server import ServerAddress
from coach_gateway.soccer.refbox.team_world_state import TeamWorldState
from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.messages.soccer.league.calls import Call
from schemas.messages.soccer.league.findings import MOST
from schemas.messages.soccer.league.lenient_json import _canonical
from schemas.messages.soccer.league.signals import BY_NAME
from schemas.side import Side
from schemas.soccer.game import OffField, Phase, Score
from support import base_stations
from support.gateway_bench import until

pytestmark = pytest.mark.anyio


@asynccontextmanager
async def boxed(*server_addresses: ServerAddress, **settings: Any) -> Any:
    """Our box beside a host, and a way to have base stations come."""
    async with base_stations.boxed(*server_addresses, **settings) as scene:
        yield scene.bench, scene.box, scene.come


def world_state(team: str, **more: Any) -> dict[str, Any]:
    return {
        "type": "worldstate",
        "teamName": team,
        "intention": "",
        "robots": [],
        "balls": [],
        "obstacles": [],
        "ageMs": 0,
        **more,
    }


async def test_a_whole_game_is_sent_to_both_teams_in_the_leagues_terms() -> None:
    """Cards and repairs follow at the next change of the game, as in RefBox."""

    async with boxed() as (bench, _, come):
        cyan, magenta = await come(team="cyan"), await come(team="Ruby")
        say = bench.stage.say
        say(phase=Phase.KICK_OFF, side=Side.CYAN)
        say(running=True)
        say(phase=Phase.PLAY, side=None)
        say(robots={"magenta2": DisciplinaryRecord(yellow=1), "cyan3": DisciplinaryRecord(off_field=OffField.REPAIR)})
        say(phase=Phase.STOPPED, running=False, score=Score(magenta=1))
        say(
            robots={
                "magenta2": DisciplinaryRecord(yellow=1),
                "cyan1": DisciplinaryRecord(off_field=OffField.SUBSTITUTION),
            }
        )
        say(phase=Phase.CORNER, side=Side.MAGENTA)
        say(running=True)
        say(phase=Phase.PARKING, side=None, running=False)
        say(phase=Phase.HALF_TIME)
        say(phase=Phase.KICK_OFF, side=Side.MAGENTA, half=2)
        say(phase=Phase.FULL_TIME, side=None)
        await until(lambda: "GAMEOVER" in cyan.commands and "GAMEOVER" in magenta.commands)
        game = [
            *("FIRST_HALF", "KICKOFF Sapphire", "START"),
            *("STOP", "GOAL Ruby", "REPAIR Sapphire 3", "YELLOW_CARD Ruby 2"),
            *("SUBSTITUTION Sapphire 1", "CORNER Ruby", "REPAIR_END Sapphire 3", "START"),
            *("STOP", "HALF_TIME", "PARK", "SECOND_HALF", "KICKOFF Ruby", "END_GAME", "GAMEOVER"),
        ]
        assert cyan.commands == ["WELCOME Sapphire", "STOP", *game]
        assert magenta.commands == ["WELCOME Ruby", "STOP", *game]


class OldTeam:
    """A base station of the years before 2020: reads single bytes, and uploads world states."""

    def __init__(self, port: int) -> None:
        self.port = port
        self.heard = b""

    async def come(self, *objects: dict[str, Any]) -> "OldTeam":
        self._reader, self.writer = await asyncio.open_connection("127.0.0.1", self.port)
        for sent in objects:
            self.writer.write(json.dumps(sent).encode() + b"\x00")
        self._task = asyncio.create_task(self._hear())
        return self

    async def leave(self) -> None:
        self.writer.transport.abort()
        await self._task

    async def _hear(self) -> None:
        try:
            while byte := await self._reader.read(1):
                self.heard += byte
        except OSError:
            self.writer.transport.abort()


def play_a_short_game(say: Callable[..., Any]) -> None:
    say(phase=Phase.KICK_OFF, side=Side.CYAN)
    say(running=True)
    say(phase=Phase.PLAY, side=None)
    say(phase=Phase.STOPPED, running=False, score=Score(magenta=1))
    say(
        phase=Phase.THROW_IN,
        side=Side.MAGENTA,
        robots={"magenta2": DisciplinaryRecord(yellow=1), "cyan1": DisciplinaryRecord(off_field=OffField.SUBSTITUTION)},
    )
    say(running=True)
    say(phase=Phase.PARKING, side=None, running=False)
    say(phase=Phase.FULL_TIME)


GAME_IN_CHARACTERS = b"1KsSatysShLz"
"""That game; a substitution has no character."""


@pytest.mark.parametrize("by", ["port", "hello"])
async def test_software_of_before_2020_reads_the_game_as_single_characters(by: str) -> None:
    """As the NuBot coach does; a base station of today at the same box reads JSON."""

    old_port = ServerAddress(0, protocol=BoxProtocol.CHARACTERS if by == "port" else BoxProtocol.JSON)
    async with boxed(old_port, ServerAddress(0)) as (bench, box, come):
        hello = {"type": "hello", "team": "cyan", "protocol": "characters"}
        sent = world_state("Sapphire", robots=[{"id": 1, "pose": [0.0, 1.0, 0.0]}])
        old = await OldTeam(box.ports[0]).come(*([hello, sent] if by == "hello" else [sent]))
        new = await come(1, team="magenta")
        await until(lambda: old.heard == b"WS" and box.team_states[Side.CYAN].states == 1)
        play_a_short_game(bench.stage.say)
        await until(lambda: old.heard.endswith(b"z") and "GAMEOVER" in new.commands)
        assert old.heard == b"WS" + GAME_IN_CHARACTERS
        assert "SUBSTITUTION Sapphire 1" in new.commands and "YELLOW_CARD Ruby 2" in new.commands
        await old.leave()


async def test_an_unknown_protocol_in_a_hello_is_named_and_ends_the_connection() -> None:
    async with boxed() as (bench, _, come):
        assert (await come(team="cyan", protocol="morse")).gone
        assert any('protocol is "morse"; it is json or characters' in line for line in bench.logged)


async def test_software_without_a_hello_gets_the_league_address_of_its_side() -> None:
    """A real base station waits for its own multicast address in targetTeam."""

    addresses = {Side.CYAN: "224.16.32.44"}
    async with boxed(addresses=addresses) as (bench, _, come):
        cyan, magenta = await come(), await come(team="Ruby")
        cyan.say(**world_state("Sapphire"))
        await until(lambda: "WELCOME 224.16.32.44" in cyan.commands)
        bench.stage.say(phase=Phase.CORNER, side=Side.CYAN)
        await until(lambda: "CORNER 224.16.32.44" in magenta.commands)
        bench.stage.say(phase=Phase.STOPPED, side=None)
        bench.stage.say(phase=Phase.THROW_IN, side=Side.MAGENTA)
        await until(lambda: "THROWIN Ruby" in cyan.commands)


async def test_a_team_may_be_called_by_an_address_of_its_own() -> None:
    async with boxed() as (bench, _, come):
        cyan = await come(team="Sapphire", address="224.16.32.44")
        assert cyan.commands[0] == "WELCOME 224.16.32.44"
        bench.stage.say(phase=Phase.CORNER, side=Side.CYAN)
        await until(lambda: "CORNER 224.16.32.44" in cyan.commands)


async def test_a_team_against_itself_is_distinguished_by_its_suffix() -> None:
    """RefBox distinguishes teams by the network they connect from; here the address does not matter."""

    async with boxed(names={"teams.cyan.name": "Twins", "teams.magenta.name": "Twins"}) as (_, _, come):
        cyan, magenta = await come(team="cyan"), await come(team="magenta")
        assert cyan.commands[0] == "WELCOME Twins"
        assert magenta.commands[0] == "WELCOME Twins:1"
        assert (await come(team="Twins")).gone


async def test_a_token_identifies_the_side_and_an_unknown_one_is_turned_away() -> None:
    tokens = {"secret-of-magenta": Side.MAGENTA}
    async with boxed(of_token=tokens.get) as (bench, _, come):
        right = await come(token="secret-of-magenta")
        assert right.commands[0] == "WELCOME Ruby"
        for guessed in ("guessed", 1, ["secret-of-magenta"]):  # what is no text would else pass for a proof
            assert (await come(token=guessed, team="magenta")).gone
        assert not right.gone
        assert any("unknown token" in line for line in bench.logged)


async def test_software_that_knows_no_hello_is_known_by_its_world_states_or_by_its_port() -> None:
    async with boxed(ServerAddress(0), ServerAddress(0, Side.CYAN)) as (_, _, come):
        by_state = await come()
        by_state.say(**world_state("ruby"))
        await until(lambda: by_state.heard)
        assert by_state.commands[0] == "WELCOME Ruby"
        by_port = await come(1)
        await until(lambda: by_port.heard)
        assert by_port.commands[0] == "WELCOME Sapphire"


async def test_a_silent_base_station_is_welcomed_without_an_address_and_receives_the_game(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(server_module, "CLIENT_S", 0.02)

    async with boxed() as (bench, _, come):
        shy = await come()
        await until(lambda: shy.heard)
        bench.stage.say(phase=Phase.CORNER, side=Side.CYAN)
        await until(lambda: len(shy.heard) == 4)
        assert shy.commands == ["WELCOME", "STOP", "FIRST_HALF", "CORNER Sapphire"]


async def test_a_base_station_that_connects_while_the_game_runs_receives_start() -> None:
    async with boxed() as (bench, _, come):
        bench.stage.say(phase=Phase.PLAY, running=True)
        await until(lambda: bench.live.state.running)
        late = await come(team="cyan")
        await until(lambda: len(late.heard) == 2)
        assert late.commands == ["WELCOME Sapphire", "START"]


async def test_a_base_station_that_comes_again_replaces_the_one_before() -> None:
    async with boxed() as (bench, _, come):
        first = await come(team="cyan")
        second = await come(team="cyan")
        await until(lambda: first.gone)
        bench.stage.say(phase=Phase.CORNER, side=Side.CYAN)
        await until(lambda: "CORNER Sapphire" in second.commands)


async def test_world_states_are_read_leniently_and_counted() -> None:

    async with boxed() as (bench, box, come):
        team = await come(team="cyan")
        team.say(**world_state("Sapphire", robots=[{"id": 1, "pose": [0.1, -8.0, 0.0]}]))
        team.say(**world_state("Sapphire", robots=[{"ID": 2.0, "Pose": [0.1, None]}]))
        team.say(type="worldstate", TeamName="Sapphire", robots=[])
        team.writer.write(b'{"half a state": [1, 2\x00')
        team.say(hello="world")
        view = box.team_states[Side.CYAN]
        await until(lambda: view.states == 3 and view.others == 1)
        found = {finding.what: finding.count for finding in [*view.findings.coped, *view.findings.lost]}
        assert found["robot without a position"] == 1
        assert found["worldstate without balls"] == 1
        await team.leave()
        await until(lambda: any("3 world states" in line and "1 pieces" in line for line in bench.logged))


def test_a_base_station_that_spells_every_key_anew_fills_no_memory() -> None:
    view = TeamWorldState()
    for number in range(3000):
        spelled = "team" + "_" * number + "Name"
        view.update(world_state("Ruby") | {spelled: "Ruby"} | {f"key{number}": 0}, 0.0)
        view.update({spelled: "Ruby", "robots": []}, 0.0)
    assert view.states == 6000
    assert len(view.findings.coped) <= MOST + 1
    assert sum(finding.count for finding in view.findings.coped) > 3000
    assert _canonical.cache_info().currsize <= 1024


async def test_a_base_station_that_never_reads_is_dropped_and_the_others_receive_everything(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async with boxed() as (bench, box, come):
        deaf = socket.socket()
        deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        deaf.setsockopt(socket.IPPROTO_TCP, socket.TCP_MAXSEG, 536)  # with large segments more is kept for it
        deaf.setblocking(False)
        await asyncio.get_running_loop().sock_connect(deaf, ("127.0.0.1", box.ports[0]))
        await asyncio.get_running_loop().sock_sendall(deaf, b'{"type": "hello", "team": "magenta"}\x00')
        cyan = await come(team="cyan")
        told = 0
        while not any("base station that does not read" in line for line in bench.logged):
            box.send([Call(BY_NAME["CORNER"], Side.CYAN)] * 1000)
            told += 1000
            assert told < 1_000_000
            await until(lambda told=told: len(cyan.heard) == told + 2)
        assert not cyan.gone
        deaf.close()


async def test_more_base_stations_than_there_is_room_for_are_turned_away(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_module, "MOST", 2)

    async with boxed() as (_, _, come):
        await come(team="cyan")
        await come(team="magenta")
        third = await come()
        await until(lambda: third.gone)


async def test_an_unidentified_base_station_gives_way_to_a_team(monkeypatch: pytest.MonkeyPatch) -> None:
    """Silent links keep no team out."""
    monkeypatch.setattr(server_module, "MOST", 3)

    async with boxed() as (bench, box, come):
        silent = []
        for number in range(3):
            silent.append(await come())
            await until(lambda number=number: len(box._peers) == number + 1)
        cyan, magenta = await come(team="cyan"), await come(team="magenta")
        await until(lambda: silent[0].gone and silent[1].gone)
        assert not silent[2].gone
        bench.stage.say(phase=Phase.KICK_OFF, side=Side.CYAN)
        await until(lambda: all("KICKOFF Sapphire" in team.commands for team in (cyan, magenta, silent[2])))


class Display(asyncio.DatagramProtocol):
    """An audience display."""

    def __init__(self) -> None:
        self.said: list[dict[str, Any]] = []

    def datagram_received(self, data: bytes, addr: Any) -> None:
        assert data.endswith(b"\x00")
        self.said.append(json.loads(data[:-1]))


async def audience(bench: Any, box: Any) -> tuple[asyncio.DatagramTransport, Display]:
    """A display that receives the feed of the box."""
    loop = asyncio.get_running_loop()
    transport, display = await loop.create_datagram_endpoint(Display, local_addr=("127.0.0.1", 0))
    address = transport.get_extra_info("sockname")[:2]
    bench.start(AudienceFeed(bench.live, [address], bench.logged.append, box.team_states))
    await until(lambda: display.said, "the feed")
    return transport, display


async def test_the_audience_receives_teams_and_events(check_world_state: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A base station's own world state, and where none comes, what our robots say."""
    monkeypatch.setattr("coach_gateway.soccer.refbox.audience_feed.WORLD_STATE_S", 1000.0)  # it is sent once

    async with boxed() as (bench, box, come):
        transport, display = await audience(bench, box)
        bench.stage.show()
        cyan = await come(team="cyan")
        mine = world_state("Sapphire", intention="win")
        cyan.say(**mine)
        await until(lambda: box.team_states[Side.CYAN].states)
        bench.stage.say(phase=Phase.KICK_OFF, side=Side.MAGENTA)
        bench.stage.say(
            phase=Phase.PLAY,
            side=None,
            running=True,
            clock=61.0,
            effective=42.0,
            score=Score(cyan=2),
            robots={"cyan2": DisciplinaryRecord(off_field=OffField.SECOND_YELLOW, yellow=2, left=33.4)},
        )
        shown = lambda: [one for one in display.said if one["type"] == "teams" and one["gameTime"] == "01:01"]  # noqa: E731
        await until(lambda: len(shown()) > 3)
        teams = shown()[0]
        assert (teams["version"], teams["gameState"], teams["gameStateString"]) == ("1.2.0", 2, "1st Half")
        assert teams["gameRunTime"] == "00:42"
        first, second = teams["teamA"], teams["teamB"]
        assert (first["shortName"], first["color"], first["score"]) == ("Sapphire", "00FFFF", "2")
        assert first["robotState"] == ["play", "doubleyellow", "play", "play", "play"]
        assert first["robotWaitTime"] == [0, 33, 0, 0, 0]
        assert first["worldState"] == mine
        check_world_state(second["worldState"])
        events = [one for one in display.said if one["type"] == "event"]
        assert events[1] == {
            "type": "event",
            "eventCode": "KICKOFF",
            "eventDesc": "Kickoff",
            "team": "Ruby",
            "robotID": -1,
        }
        assert (events[-1]["eventCode"], events[-1]["robotID"]) == ("DOUBLE_YELLOW", 2)
        told = len(shown())
        await asyncio.sleep(0.2)
        assert len(shown()) - told <= 6, "twenty a second"
        transport.close()


async def test_a_world_state_that_is_too_large_does_not_silence_the_audience_feed(check_world_state: Any) -> None:
    async with boxed() as (bench, box, come):
        transport, display = await audience(bench, box)
        bench.stage.show()
        cyan = await come(team="cyan")
        cyan.say(**world_state("Sapphire", intention="x" * 64_500))
        await until(lambda: box.team_states[Side.CYAN].states)
        told = len(display.said)
        await until(lambda: len(display.said) > told + 3)
        check_world_state(display.said[-1]["teamA"]["worldState"])
        assert bench.logged[-1] == (
            "referee box: world state that is not passed on from 127.0.0.1 (more than 30000 bytes); "
            "further ones are counted"
        )
        transport.close()
