"""Our base station at a small referee box, written from the protocol's tables, over real sockets."""

import asyncio
import contextlib
import itertools
import socket
from collections.abc import Callable
from typing import Any

import pytest

from coach_gateway.soccer.refbox import client as client_module
from coach_gateway.soccer.refbox.client import BoxAddress, RefBoxClient
from coach_gateway.timing import BOX_PERIOD_S
from schemas.messages.coach import CoachMode
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName, Phase
from support.box_client import connected
from support.gateway_bench import opened, until
from support.referee_box import CYAN_AT, MAGENTA_AT, Box

pytestmark = pytest.mark.anyio

RESTARTS = {"KICKOFF": "kick_off", "FREEKICK": "free_kick", "GOALKICK": "goal_kick", "THROWIN": "throw_in"}
RESTARTS |= {"CORNER": "corner", "PENALTY": "penalty"}


def asked(bench: Any) -> list[str]:
    """What the referee was asked for: `corner cyan`, `repair cyan2`."""
    assert all(action.source == REFBOX for action in bench.stage.asked)
    assert all((action.referee or "").startswith("box_127_0_0_1_") for action in bench.stage.asked)
    return [" ".join(filter(None, (action.action, action.side, action.robot))) for action in bench.stage.asked]


async def test_every_restart_in_json_reaches_the_referee_for_the_right_side() -> None:
    """With the addresses of the box; the first that is welcomed is ours."""

    async with connected() as (bench, box, _):
        bench.stage.say(phase=Phase.STOPPED)
        for name in RESTARTS:
            box.say(name, CYAN_AT)
            box.say(name, MAGENTA_AT, robotID=-1)
        await until(lambda: len(bench.stage.asked) == 2 * len(RESTARTS))
        assert asked(bench) == [f"{word} {side}" for word in RESTARTS.values() for side in Side]


async def test_a_command_from_before_the_match_is_known_is_forwarded_as_soon_as_it_is() -> None:
    async with opened() as bench:
        known, bench.live.setup = bench.live.setup, None
        box = Box()
        client = RefBoxClient(bench.live, BoxAddress(Side.CYAN, "127.0.0.1", await box.open()), bench.logged.append)
        bench.start(client)
        await until(lambda: box.links and client.connected)
        box.say("START")
        await until(lambda: client.counts["received"])
        assert asked(bench) == []
        bench.live.setup = known
        await until(lambda: asked(bench) == ["start"])
        bench.stop.set()
        await box.close()


async def test_every_restart_as_a_character_reaches_the_referee_for_the_right_side() -> None:
    async with connected(greets=False) as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        box.send(b"WKkFfGgTtCcPpN")
        await until(lambda: len(bench.stage.asked) == 2 * len(RESTARTS) + 1)
        expected = [f"{word} {side}" for word in RESTARTS.values() for side in Side]
        assert asked(bench) == [*expected, "drop_ball"]
        assert client.counts["unreadable"] == 0


async def test_cards_repairs_and_substitutions_find_their_robot_by_its_number_or_else_their_side() -> None:
    async with connected() as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        box.say("YELLOW_CARD", CYAN_AT, robotID=2)
        box.say("REPAIR", MAGENTA_AT, robotID="3")
        box.say("RED_CARD", MAGENTA_AT, robotID=-1)
        box.say("SUBSTITUTION", CYAN_AT, robotID=9)
        box.say("REPAIR_END", MAGENTA_AT, robotID=3)
        await until(lambda: len(bench.stage.asked) == 5)
        named = ["yellow_card cyan2", "repair magenta3", "enter magenta3"]
        assert asked(bench) == [*named[:2], "red_card magenta", "substitute cyan", named[2]]
        assert client.counts["not forwarded"] == 0
        assert any("SUBSTITUTION names robot 9, and no robot of cyan" in line for line in bench.logged)


async def test_start_lets_the_game_run_though_our_referee_takes_it_in_steps() -> None:
    """The box's START after its kick-off lets play begin; ours first signals, waits for the ball, then starts."""

    async with connected() as (bench, box, _):
        bench.stage.say(phase=Phase.STOPPED)
        steps: list[dict[str, Any] | str] = [
            {"phase": Phase.KICK_OFF, "side": Side.CYAN},
            "the ball is being put back",
            {"running": True},
        ]

        def answer(action: RefereeAction) -> ActionReply:
            step = steps.pop(0)
            if isinstance(step, str):
                return ActionReply(accepted=False, reason=step)
            bench.stage.say(**step)
            return ActionReply(accepted=True, tick=bench.stage.state.tick)

        bench.stage.answer = answer
        box.say("START")
        await until(lambda: bench.live.state.running)
        await asyncio.sleep(0.2)
        assert asked(bench) == ["start", "start", "start"]
        assert not any("put back" in line for line in bench.logged)


async def test_a_command_without_a_reply_is_repeated_and_later_ones_wait_for_it(monkeypatch) -> None:
    """The box sends it once; a START that overtook a repair would let the game run with the broken robot."""
    monkeypatch.setattr(client_module, "GIVE_UP_S", 0.1)
    async with connected() as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        replies = [None, None, ActionReply(accepted=True), ActionReply(accepted=True)]
        bench.stage.answer = lambda _: replies.pop(0)
        box.say("REPAIR", MAGENTA_AT, robotID=3)
        box.say("KICKOFF", CYAN_AT)
        await until(lambda: len(bench.stage.asked) == 4)
        assert asked(bench) == ["repair magenta3"] * 3 + ["kick_off cyan"]
        await until(lambda: client.counts["forwarded"] == 2)
        assert client.counts["repeated"] == 2
        noted = [line for line in bench.logged if line.startswith("note: repair magenta3 of the referee box: no reply")]
        assert len(noted) == 1


async def test_a_card_right_behind_start_does_not_keep_the_game_from_running() -> None:
    """The league's box sends cards when its own state has changed, which is at START."""

    async with connected() as (bench, box, _):
        bench.stage.say(phase=Phase.THROW_IN, side=Side.CYAN)
        refusals = ["the ball is being put back"] * 3

        def answer(action: RefereeAction) -> ActionReply:
            if action.action is ActionName.START and refusals:
                return ActionReply(accepted=False, reason=refusals.pop())
            if action.action is ActionName.START:
                bench.stage.say(running=True)
            return ActionReply(accepted=True, tick=bench.stage.state.tick)

        bench.stage.answer = answer
        box.say("START")
        box.say("YELLOW_CARD", CYAN_AT)
        await until(lambda: bench.live.state.running and len(bench.stage.asked) == 5)
        assert asked(bench) == ["start"] * 4 + ["yellow_card cyan"]


async def test_a_stop_is_not_held_up_by_a_start_that_leads_nowhere() -> None:
    async with connected() as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        bench.stage.answer = lambda action: ActionReply(
            accepted=action.action is not ActionName.START, reason="not now"
        )
        box.say("START")
        await until(lambda: len(bench.stage.asked) > 1)
        box.say("STOP")
        await until(lambda: asked(bench)[-1] == "stop")
        assert client.counts["refused"] == 1
        assert "referee box: not now" in bench.logged


async def test_a_start_while_no_host_plays_is_logged_as_refused() -> None:
    async with connected() as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        await until(lambda: bench.live.follower.host_present)
        bench.stage.bus.withdraw_alive("host", "host")
        await until(lambda: bench.live.follower.gone)
        box.say("START")
        await until(lambda: client.counts["refused"] == 1)
        assert asked(bench) == [] and "referee box: START is not forwarded: no host plays" in bench.logged


async def test_park_is_ordered_to_the_robots_and_the_next_command_has_them_play() -> None:
    async with connected() as (bench, box, _):
        bench.stage.say(phase=Phase.HALF_TIME)
        box.say("PARK")
        await until(lambda: len(bench.stage.given_orders) == 2)
        bench.stage.say(phase=Phase.STOPPED, half=2)
        await until(lambda: bench.live.state.half == 2)
        box.say("KICKOFF", MAGENTA_AT)
        await until(lambda: len(bench.stage.given_orders) == 4)
        modes = [(side, order.mode) for side, order in bench.stage.given_orders]
        assert modes == [(side, mode) for mode in (CoachMode.PARK, CoachMode.PLAY) for side in Side]


async def test_the_world_is_uploaded_at_ten_hertz_or_more_in_the_leagues_schema(
    check_world_state: Callable[[Any], None],
) -> None:

    async with connected(team=Side.MAGENTA) as (bench, box, client):
        bench.stage.show()
        await until(lambda: len(box.states) >= 20)
        assert BOX_PERIOD_S <= 0.1
        assert client.counts["left out"] == 0
        for state in box.states:
            check_world_state(state)
        assert [robot["id"] for robot in box.states[-1]["robots"]] == [1, 2, 3]
        assert box.states[-1]["robots"][0]["pose"][:2] == [0.0, -1.0]  # behind the centre, on its own half
        assert box.states[-1]["balls"][0]["position"] == [-1.0, -2.0, 0.11]


async def test_manual_actions_are_locked_while_the_link_is_up_and_not_after() -> None:
    async with connected() as (bench, box, _):
        watch = bench.stage.bus.watch_alive()
        seen = [presence for presence in iter(watch.receive, None) if presence.kind == REFBOX]
        assert [(one.name, one.alive) for one in seen] == [("cyan", True)]
        await until(lambda: bench.live.refboxes == [Side.CYAN])
        await box.close()
        await until(lambda: bench.live.refboxes == [])
        gone = [presence for presence in iter(watch.receive, None) if presence.kind == REFBOX]
        assert [(one.name, one.alive) for one in gone] == [("cyan", False)]


async def test_a_referee_of_ours_that_decides_beside_the_box_is_logged() -> None:
    async with connected() as (bench, _, _):
        await until(lambda: any("--referee manual" in line for line in bench.logged))


async def test_a_link_that_breaks_in_the_middle_of_a_command_is_made_again() -> None:
    async with connected() as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        box.came = 0  # the next base station is welcomed as the first one was
        box.send(b'{"command": "CORNER", "targetTe')
        await asyncio.sleep(0.02)
        box.hang_up()
        await until(lambda: client.counts["connections"] == 2 and box.links)
        box.say("THROWIN", CYAN_AT)
        await until(lambda: bench.stage.asked)
        assert asked(bench) == ["throw_in cyan"]


async def test_a_box_that_drops_every_link_is_tried_less_and_less_often() -> None:
    """Like a tunnel whose other end is missing: it accepts each link, and drops it."""

    came: list[float] = []

    async def meet(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        came.append(asyncio.get_running_loop().time())
        writer.transport.abort()

    async with opened() as bench, await asyncio.start_server(meet, "127.0.0.1", 0) as tunnel:
        port = tunnel.sockets[0].getsockname()[1]
        bench.start(RefBoxClient(bench.live, BoxAddress(Side.CYAN, "127.0.0.1", port), bench.logged.append))
        await until(lambda: len(came) == 4)
        first, second, third = (b - a for a, b in itertools.pairwise(came))
        assert first >= 0.24 and second >= 0.49 and third >= 0.99
        bench.stop.set()


async def test_an_unknown_command_that_comes_again_and_again_is_logged_once() -> None:
    async with connected() as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        for _ in range(500):
            box.say("DANCE")
        await until(lambda: client.counts["unreadable"] == 500)
        assert sum("is not a command" in line for line in bench.logged) == 1


async def test_a_box_that_comes_late_is_connected() -> None:
    async with opened() as bench:
        box = Box()
        port = await box.open()
        await box.close()
        client = RefBoxClient(bench.live, BoxAddress(Side.CYAN, "127.0.0.1", port), bench.logged.append)
        bench.start(client)
        await until(lambda: any("is not there" in line for line in bench.logged))
        await box.open(port)
        await until(lambda: client.connected)
        assert sum("is not there" in line for line in bench.logged) == 1
        bench.stop.set()
        await box.close()


async def test_a_box_that_never_reads_misses_world_states_and_delays_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("coach_gateway.soccer.refbox.client.UNREAD_BYTES", 20_000)
    monkeypatch.setattr("coach_gateway.soccer.refbox.client.BOX_PERIOD_S", 0.0005)

    async with connected(reads=False) as (bench, box, client):
        bench.stage.say(phase=Phase.STOPPED)
        bench.stage.show()
        await until(lambda: client.counts["left out"] > 20, "a full pipe")
        box.say("CORNER", CYAN_AT)
        await until(lambda: bench.stage.asked)
        assert asked(bench) == ["corner cyan"]


async def test_a_box_that_has_not_read_for_long_is_left_and_met_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("coach_gateway.soccer.refbox.client.UNREAD_BYTES", 20_000)
    monkeypatch.setattr("coach_gateway.soccer.refbox.client.BOX_PERIOD_S", 0.0005)
    monkeypatch.setattr("coach_gateway.soccer.refbox.client.UNREAD_S", 0.1)

    async with connected(reads=False) as (bench, _, client):
        bench.stage.show()
        await until(lambda: client.counts["connections"] > 1)


async def test_a_gateway_that_waits_for_a_box_ends_when_stopped() -> None:
    """The box's machine is there, but does not accept."""

    with socket.socket() as full:
        full.bind(("127.0.0.1", 0))
        full.listen(0)
        others = [socket.socket() for _ in range(4)]
        for other in others:
            other.setblocking(False)
            with contextlib.suppress(BlockingIOError):
                other.connect(full.getsockname())
        async with opened() as bench:
            box = BoxAddress(Side.CYAN, "127.0.0.1", full.getsockname()[1])
            task = bench.start(RefBoxClient(bench.live, box, bench.logged.append))
            await asyncio.sleep(0.05)
            bench.stop.set()
            await until(task.done)
        for other in others:
            other.close()


async def test_two_base_stations_of_ours_at_one_box_pass_each_command_on_once() -> None:
    async with opened() as bench:
        box = Box()
        port = await box.open()
        for number, team in enumerate(Side, 1):
            bench.start(RefBoxClient(bench.live, BoxAddress(team, "127.0.0.1", port), bench.logged.append))
            await until(lambda number=number: len(box.links) == number)
        await until(lambda: bench.live.refboxes == list(Side))
        bench.stage.say(phase=Phase.STOPPED)
        box.say("GOAL", CYAN_AT)
        box.say("GOAL", MAGENTA_AT)
        box.say("DROP_BALL")
        await until(lambda: len(bench.stage.asked) == 3)
        await asyncio.sleep(0.1)
        assert sorted(asked(bench)) == ["drop_ball", "goal cyan", "goal magenta"]
        bench.stop.set()
        await box.close()
