"""Attacks on the port of our referee box: garbage, floods, taken places, and claims of the other side's team."""

import asyncio
from contextlib import AbstractAsyncContextManager
from typing import Any

import pytest

from coach_gateway.soccer.refbox import peers
from coach_gateway.soccer.refbox.audience_feed import AudienceFeed
from coach_gateway.soccer.refbox.framing import Framer
from coach_gateway.soccer.refbox.server import ServerAddress
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side
from support.base_stations import Boxed, boxed
from support.gateway_bench import until

pytestmark = pytest.mark.anyio

TOKENS = {"token-of-cyan": Side.CYAN, "token-of-magenta": Side.MAGENTA}


def attacked(*addresses: ServerAddress) -> AbstractAsyncContextManager[Boxed]:
    return boxed(*addresses, of_token=TOKENS.get)


GARBAGE = [
    b"\x00" * 100_000,
    b"\xff\xfe\xfd" * 10_000 + b"\x00",
    b"x" * 200_000,
    b"{" * 60_000 + b"\x00",
    b'{"a":' + b"[" * 980 + b"]" * 980 + b"}\x00",
    b'{"type": "worldstate", "robots": ' + b"[" * 500 + b"]" * 500 + b"}\x00",
    b"{}" * 32_000 + b"\x00",
    b'{"type": "hello", "team": "\\ud800"}\x00',
    b'{"type": "hello", "token": "\\ud800"}\x00',
    b'{"type": "hello", "team": ["cyan"]}\x00',
    b'{"type": "worldst',
    b'{"type": "hello", "team": {"cyan": 1}, "token": 7}\x00',
    b'{"type": "worldstate", "robots": [' + b'{"id": 1e999, "pose": [NaN, Infinity]},' * 500 + b"{}]}\x00",
    b'{"type": "worldstate", "teamName": "' + b"\\ud800" * 1000 + b'", "robots": []}\x00',
    b"GET / HTTP/1.1\r\nHost: a\r\n\r\n",
    b"\x16\x03\x01\x02\x00\x01",
]


async def test_garbage_of_every_kind_stops_no_base_station() -> None:
    faults: list[Any] = []
    asyncio.get_running_loop().set_exception_handler(lambda _, fault: faults.append(fault))
    async with attacked() as scene:
        cyan = await scene.come(source="127.0.0.3", team="cyan")
        bench, ruby = scene.bench, scene.box.team_states[Side.MAGENTA]
        bench.start(AudienceFeed(bench.live, [("127.0.0.1", 9)], bench.logged.append, scene.box.team_states))
        for garbage in GARBAGE:
            attacker = await scene.come()
            attacker.send(garbage)
            friend = await scene.come(source="127.0.0.4", team="magenta")
            friend.send(garbage + b"\x00", {"type": "worldstate", "teamName": "Ruby", "robots": []})
            before = ruby.states
            await until(lambda before=before, friend=friend: ruby.states > before or friend.gone)
            await attacker.leave()
            await friend.leave()
        await scene.plays_on(cyan)
        assert all(not task.done() for task in bench.tasks)
    assert faults == []


def test_a_piece_of_very_many_or_very_deep_objects_costs_no_more_than_a_few() -> None:
    framer = Framer(BoxProtocol.JSON)
    assert len(framer.feed(b"{}" * 30_000 + b"\x00")) == 100
    assert framer.feed(b'{"a":' + b"[" * 900 + b"]" * 900 + b"}\x00") == []
    assert framer.garbage == 2


async def test_a_name_alone_replaces_no_base_station_with_a_token_and_none_that_is_in_use_elsewhere() -> None:
    async with attacked() as scene:
        cyan = await scene.come(source="127.0.0.3", token="token-of-cyan")
        magenta = await scene.come(source="127.0.0.4", team="magenta")
        for claim in ({"team": "cyan"}, {"team": "Ruby"}, {"team": "magenta", "address": "mine"}):
            thief = await scene.come(**claim)
            await until(lambda thief=thief: thief.gone)
            assert thief.commands == []
        near = await scene.come(source="127.0.0.3", team="cyan")  # even on the same machine
        await until(lambda: near.gone)
        by_name = await scene.come()
        by_name.send({"type": "worldstate", "teamName": "Ruby", "robots": [{"id": 1}]})
        await until(lambda: by_name.gone)
        assert scene.box.team_states[Side.MAGENTA].states == 0
        await scene.plays_on(cyan, magenta)
        assert (
            "referee box: hello from 127.0.0.1 (it claims to be cyan's, and its base station has proven "
            "more; send the token of its coach in the hello); further ones are counted"
        ) in scene.bench.logged
        again = await scene.come(source="127.0.0.6", token="token-of-cyan")  # the same team from elsewhere
        await until(lambda: cyan.gone)
        await scene.plays_on(again)


async def test_a_base_station_that_has_fallen_silent_is_replaced_from_another_address(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(peers, "SILENCE_S", 0.0)

    async with attacked() as scene:
        lost = await scene.come(source="127.0.0.3", team="cyan")
        found = await scene.come(source="127.0.0.4", team="cyan")
        await until(lambda: lost.gone)
        await scene.plays_on(found)


async def test_the_port_of_one_team_is_not_for_the_other() -> None:
    async with attacked(ServerAddress(0, Side.CYAN), ServerAddress(0)) as scene:
        cyan = await scene.come(0, source="127.0.0.3")
        await until(lambda: cyan.commands)
        for claim in ({"team": "magenta"}, {"token": "token-of-magenta"}):
            stray = await scene.come(0)
            stray.send({"type": "hello", **claim})
            await until(lambda stray=stray: stray.gone)
        by_name = await scene.come(1, team="cyan")
        await until(lambda: by_name.gone)
        magenta = await scene.come(1, source="127.0.0.4", token="token-of-magenta")
        await scene.plays_on(magenta)


async def test_world_states_in_a_flood_hold_up_no_command_to_others() -> None:
    async with attacked() as scene:
        cyan = await scene.come(source="127.0.0.3", team="cyan")
        flooder = await scene.come(team="magenta")
        flooder.send(b'{"type": "worldstate", "teamName": "Ruby", "robots": []}\x00' * 50_000)
        await scene.plays_on(cyan)
        assert scene.box.team_states[Side.MAGENTA].states < 50_000
