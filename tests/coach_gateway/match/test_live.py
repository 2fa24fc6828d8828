"""A match as bridges see it, while hosts come and go."""

import asyncio
import threading
from typing import Any

import pytest

from coach_gateway.match.live import LiveMatch
from coach_gateway.soccer.refbox.call_generator import CallGenerator
from runtime.process.clock import WallClock
from schemas.config.match_config import load_match
from schemas.messages.soccer.game import GameState, RefereeAction
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName, Phase, Score
from schemas.topics import SETUP, STATE
from support.gateway_bench import kicked_off, opened, until
from support.in_process_bus import SharedState
from support.messages import make_setup
from support.stepped_clock import SteppedClock

pytestmark = pytest.mark.anyio


async def test_without_a_host_the_reply_is_a_refusal_with_the_reason() -> None:
    async with opened() as bench:
        bench.stage.bus.close()
        await until(lambda: not bench.live.follower.host_present)
        reply = await bench.live.act(RefereeAction(action=ActionName.STOP))
        assert not reply.accepted and "no process answers game/action" in reply.reason


async def test_after_an_action_the_state_is_what_it_has_led_to() -> None:
    """Who decides by the state, as base stations do, would decide by one from before his own last action."""

    async with kicked_off(**{"referee.mode": "manual", "duration": 3600.0}) as bench:
        for action, score in [(ActionName.GOAL, 1), (ActionName.CANCEL_GOAL, 0)] * 3:
            reply = await bench.live.act(RefereeAction(action=action, side=Side.CYAN))
            assert reply.accepted and bench.live.state.score.cyan == score
            refused = await bench.live.act(RefereeAction(action=ActionName.ENTER, robot="cyan1"))
            assert not refused.accepted and bench.live.state.tick >= refused.tick > reply.tick


async def test_a_host_that_comes_after_another_is_asked_anew_and_nothing_of_the_old_match_counts() -> None:
    async with opened() as bench:
        told: list[str] = []
        call_generator = CallGenerator()
        bench.live.on_state(
            lambda state: told.extend(call.signal.name for call in call_generator.next_calls(state, bench.live.sides))
        )
        for _ in range(100):
            bench.stage.say(phase=Phase.STOPPED, score=Score(cyan=2))
        bench.stage.tell("of the old match")
        await until(lambda: bench.live.follower.events and bench.live.state.score.cyan == 2)
        assert len(bench.live.sides) == 6
        bench.stage.bus.close()
        await until(lambda: not bench.live.follower.host_present)
        another = type(bench.stage)(bench.stage.medium, load_match(None, {f"teams.{side}.size": 1 for side in Side}))
        bench.start(another)
        await until(lambda: len(bench.live.sides) == 2)
        told.clear()
        another.say(phase=Phase.KICK_OFF, side=Side.CYAN)
        await until(lambda: bench.live.state.phase is Phase.KICK_OFF)
        assert bench.live.follower.events == []
        assert told == ["RESET", "FIRST_HALF", "KICKOFF"]


async def test_a_stop_waits_for_no_other_request() -> None:
    async with opened() as bench:
        held = threading.Event()
        act = bench.live._client.act
        bench.live._client.act = lambda action, *patience: (
            held.wait(30.0) and act(action) if action.action is ActionName.GOAL else act(action, *patience)
        )
        goals = [asyncio.create_task(bench.live.act(RefereeAction(action=ActionName.GOAL))) for _ in range(50)]
        await asyncio.sleep(0)
        assert (await bench.live.act(RefereeAction(action=ActionName.STOP))).accepted
        assert (await bench.live.act(RefereeAction(action=ActionName.START, source=REFBOX))).accepted
        assert not any(goal.done() for goal in goals)
        held.set()
        await asyncio.gather(*goals)


async def test_an_order_of_one_side_does_not_wait_for_the_other_side() -> None:
    async with opened() as bench:
        held = threading.Event()
        bench.live._order_clients[Side.CYAN].order = lambda *_, **__: held.wait(30.0)
        slow = [asyncio.create_task(bench.live.order(Side.CYAN, mode="hold")) for _ in range(50)]
        await asyncio.sleep(0)
        assert (await bench.live.order(Side.MAGENTA, mode="hold")).mode == "hold"
        assert not any(one.done() for one in slow)
        held.set()
        await asyncio.gather(*slow)


async def test_a_setup_that_changes_while_the_host_replies_is_queried_again() -> None:
    medium, clock = SharedState(), SteppedClock()
    host, live = medium.open_bus("friendly", WallClock()), LiveMatch(medium.open_bus("friendly", clock))
    server, states = host.serve(SETUP), host.publisher(STATE)
    asked: list[Any] = []

    def look() -> int:
        live.update()
        asked.extend(iter(server.receive, None))
        return len(asked)

    states.put(GameState(tick=1, time=0.02, phase=Phase.PLAY))
    await until(look, "the question")
    states.put(GameState(tick=2, time=0.04, phase=Phase.PLAY, episode=2))
    look()
    asked[0].reply(make_setup(size=1))  # as it was before the scene that came meanwhile
    await until(lambda: len(live.sides) == 2)
    clock.sleep_until(10.0)
    await until(lambda: look() == 2, "another question")
    asked[1].reply(make_setup(size=3))
    await until(lambda: len(live.sides) == 6)
    stop = asyncio.Event()
    stop.set()
    await live.serve(stop)


async def test_a_gateway_that_ends_sends_no_more_requests() -> None:
    live = LiveMatch(SharedState().open_bus("friendly", WallClock()))
    stop = asyncio.Event()
    stop.set()
    await live.serve(stop)
    reply = await live.act(RefereeAction(action=ActionName.STOP))
    assert (reply.accepted, reply.reason) == (False, "the gateway is shutting down")
