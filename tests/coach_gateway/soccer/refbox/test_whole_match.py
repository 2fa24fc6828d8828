"""A whole match by the league's box: our base station and our referee between it and real robots' agents."""

import asyncio
import json
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import pytest

from coach_gateway.ports import LOOPBACK, bound_socket
from coach_gateway.soccer.refbox.client import BoxAddress, RefBoxClient
from coach_gateway.soccer.refbox.server import RefBoxServer, ServerAddress
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, Phase
from support.gateway_bench import kicked_off, until
from support.referee_box import CYAN_AT, MAGENTA_AT, Box

pytestmark = pytest.mark.anyio


@asynccontextmanager
async def officiated(**words: Any) -> AsyncIterator[tuple[Any, Box]]:
    """A match with manual officiating, and a box that cyan's base station is connected to."""
    async with kicked_off(**{"referee.mode": "manual", "rules": "friendly", "duration": 3600.0} | words) as bench:
        box = Box()
        port = await box.open()
        bench.start(RefBoxClient(bench.live, BoxAddress(Side.CYAN, "127.0.0.1", port), bench.logged.append))
        await until(lambda: box.links and bench.live.refboxes)
        yield bench, box
        await box.close()


@pytest.mark.long
async def test_a_game_of_longer_halves_with_cards_for_no_robot_ends_with_the_score_of_the_box() -> None:
    """By the commands of the league's own box, in its order, with halves of 14 s where ours have 10.

    It names no robot for cards and repairs. Cyan's coach answers once; magenta's has one robot, which needs no answer.
    """

    async with officiated(**{"duration": 20.0, "teams.magenta.size": 2}) as (bench, box):
        state = lambda: bench.stage.state  # noqa: E731  the referee's own
        away = lambda: {name: it.why.value for name, it in state().participation.absences.items()}  # noqa: E731

        async def restart(command: str, target: str, phase: Phase) -> None:
            box.say(command, target)
            await until(lambda: state().phase is phase, command)
            box.say("START")
            await until(lambda: state().running, "START")

        async def played_until(clock: float) -> None:
            await until(lambda: state().clock >= clock, f"{clock} s of play")

        box.say("KICKOFF", MAGENTA_AT)
        box.say("FIRST_HALF")
        box.say("START")
        await until(lambda: state().running and state().side is Side.MAGENTA, "the first half")
        await played_until(3.0)
        box.say("STOP")
        box.say("GOAL", CYAN_AT)
        box.say("KICKOFF", MAGENTA_AT)
        box.say("YELLOW_CARD", CYAN_AT)
        await until(lambda: bench.live.state.questions, "the question")
        by_hand = RefereeAction(action=ActionName.NAME_ROBOT, robot="cyan1", source="cyan's coach")
        assert (await bench.live.act(by_hand)).accepted
        assert state().participation.cards["cyan1"].yellow == 1
        box.say("START")
        await until(lambda: state().running, "START after the goal")
        await played_until(9.0)
        box.say("STOP")
        await restart("THROWIN", MAGENTA_AT, Phase.THROW_IN)
        await played_until(14.0)
        assert (state().half, state().running) == (1, True)
        box.say("STOP")
        box.say("HALF_TIME")
        box.say("PARK")
        await until(lambda: state().phase is Phase.HALF_TIME, "the break")

        box.say("KICKOFF", CYAN_AT)
        box.say("SECOND_HALF")
        box.say("START")
        await until(lambda: state().half == 2 and state().running, "the second half")
        await played_until(17.0)
        box.say("STOP")
        box.say("REPAIR", MAGENTA_AT)
        await until(lambda: state().questions, "the question to magenta")
        await until(lambda: away() == {"magenta2": "repair"}, "the default after 10 s")
        box.say("REPAIR_END", MAGENTA_AT)
        await until(lambda: not away(), "the end of the only repair")
        box.say("GOAL", MAGENTA_AT)
        box.say("GOAL", CYAN_AT)
        await restart("KICKOFF", MAGENTA_AT, Phase.KICK_OFF)
        await played_until(28.5)
        box.say("STOP")
        box.say("DOUBLE_YELLOW", CYAN_AT)
        await until(lambda: away() == {"cyan2": "second_yellow"}, "the default for the second yellow card")
        assert (state().half, state().phase) == (2, Phase.STOPPED)
        box.say("END_GAME")
        await until(lambda: bench.stage.host.simulation.over, "the end")
        assert (state().score.cyan, state().score.magenta) == (2, 1)
        assert not any("refused" in line or "no half" in line for line in bench.logged), bench.logged


async def test_a_box_need_not_wait_between_its_commands() -> None:
    """All in one packet: each command is carried out in the state that the one before has led to."""

    async with officiated() as (bench, box):
        box.say("KICKOFF", CYAN_AT)
        box.say("FIRST_HALF")
        box.say("START")
        await until(lambda: bench.stage.state.running, "the first half")
        box.say("STOP")
        box.say("GOAL", MAGENTA_AT)
        box.say("HALF_TIME")
        box.say("KICKOFF", MAGENTA_AT)
        box.say("SECOND_HALF")
        box.say("START")
        await until(lambda: bench.stage.state.half == 2 and bench.stage.state.running, "the second half")
        assert bench.stage.state.score.magenta == 1


@pytest.mark.long
async def test_a_team_of_the_league_receives_the_match_that_our_referee_officiates() -> None:
    """By itself: kick-off, START, and a stall that is dropped."""

    async with kicked_off(rules="friendly") as bench:
        bound = bound_socket("--refbox-server", LOOPBACK, 0, socket.SOCK_STREAM)
        box = RefBoxServer(bench.live, [ServerAddress(0, Side.MAGENTA)], [bound], bench.logged.append)
        bench.start(box)
        await until(lambda: box.ports)
        reader, writer = await asyncio.open_connection("127.0.0.1", box.ports[0])
        heard: list[str] = []
        async with asyncio.timeout(240):
            while "DROP_BALL" not in heard:
                heard.append(json.loads((await reader.readuntil(b"\x00"))[:-1])["command"])
        assert heard[0] == "WELCOME"
        assert heard.index("STOP", 2) < heard.index("DROP_BALL")
        writer.transport.abort()
