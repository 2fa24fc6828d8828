"""A referee box that attacks the base station which is connected to it: garbage, floods, endless lines, silence."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import pytest

from coach_gateway.soccer.refbox import signal_queue
from coach_gateway.soccer.refbox.client import RefBoxClient
from schemas.messages.soccer.game import ActionReply
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.soccer.game import ActionName, Phase
from support.box_client import connected
from support.gateway_bench import Bench, until
from support.referee_box import Box

pytestmark = pytest.mark.anyio


@asynccontextmanager
async def stopped(protocol: BoxProtocol = BoxProtocol.AUTO) -> AsyncIterator[tuple[Bench, Box, RefBoxClient]]:
    """A box and a base station that is connected to it, beside a host whose game is stopped."""
    async with connected(protocol) as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        yield bench, box, client


GARBAGE = [
    b"\x00" * 10_000,
    bytes(range(128, 256)) * 100 + b"\x00",
    b'{"command": ' + b"[" * 980 + b"]" * 980 + b"}\x00",
    b'{"a": ' + b"{" * 20_000 + b"\x00",
    b"{}" * 30_000 + b"\x00",
    b'{"command": "START' + b"x" * 300_000 + b'"}\x00',
    b'{"command": "\\ud800"}\x00',
    b'{"command": {"command": "START"}}\x00',
    b'{"command": ["START"]}\x00',
    b'{"command": "START", "robotID": 1e999}{"command": NaN}\x00',
    b'{"command": "REPAIR", "targetTeam": 7, "robotID": -5}\x00',
    b'{"command": "REPAIR", "robotID": "999999999999"}\x00',
    b'{"command": "GOAL", "targetTeam": "' + b"y" * 60_000 + b'"}\x00',
    b'{"command": "stop\x1b[2J"}\x00',
    b"HTTP/1.1 200 OK\r\n\r\n\x00",
]


@pytest.mark.parametrize("protocol", [BoxProtocol.AUTO, BoxProtocol.JSON])
async def test_garbage_of_a_box_is_counted_and_its_next_command_is_forwarded(protocol: BoxProtocol) -> None:
    async with stopped(protocol) as (bench, box, client):
        for garbage in GARBAGE:
            box.send(garbage)
            forwarded = sum(action.action is ActionName.STOP for action in bench.stage.asked)
            box.say("STOP")
            await until(
                lambda before=forwarded: sum(action.action is ActionName.STOP for action in bench.stage.asked) > before,
                repr(garbage[:40]),
            )
        assert client.connected and client.counts["connections"] == 1 and client.counts["unreadable"] > 5
        assert all(action.robot is None for action in bench.stage.asked)
        assert all(line.isprintable() and len(line) < 300 for line in bench.logged if "referee box" in line)


async def test_a_box_that_floods_start_and_stop_is_forwarded_in_turn_and_neither_fills_memory_nor_the_log() -> None:
    async with stopped() as (bench, box, client):
        bench.stage.answer = lambda _: ActionReply(accepted=False, reason="not now")
        flood = b'{"command": "START"}\x00{"command": "STOP"}\x00' * 20_000
        box.send(flood)
        box.say("GOAL", "224.16.32.44")
        await until(lambda: client.counts["received"] > 40_000)
        await until(lambda: bench.stage.asked and bench.stage.asked[-1].action is ActionName.GOAL)
        assert client.counts["dropped"] > 30_000
        assert len(bench.stage.asked) <= 40_000 - client.counts["dropped"] + signal_queue.MOST_WAITING
        assert len([line for line in bench.logged if "not now" in line]) <= 40


@pytest.mark.parametrize("flood", [b"S", b"sS" * 10, b"?" * 100, b"Kk1\x00\r\n "])
async def test_characters_in_a_flood_leave_the_last_one_in_force(flood: bytes) -> None:
    async with stopped(BoxProtocol.CHARACTERS) as (bench, box, client):
        box.send(flood * 5000 + b"N")  # a drop ball
        await until(
            lambda: bench.stage.asked and bench.stage.asked[-1].action is ActionName.DROP_BALL, "the last character"
        )
        assert client.connected
