"""Coach programs over real UDP sockets."""

import asyncio
import json
import socket
import subprocess
import sys
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from coach_gateway.access.tokens import Tokens
from coach_gateway.ports import LOOPBACK, bound_socket
from coach_gateway.udp import session as session_module
from coach_gateway.udp.server import UdpServer
from schemas.messages.coach import ActiveOrder, CoachMode, CoachOrder
from schemas.messages.radio import Motion, Radio
from schemas.messages.soccer.game import ActionReply
from schemas.side import Side
from schemas.soccer.game import Phase, Point
from schemas.topics import ACTIVE_ORDER
from support.gateway_bench import kicked_off, opened, until

pytestmark = pytest.mark.anyio

TOKENS = Tokens("referee-token", "cyan-token", "magenta-token")
EXAMPLE = Path(__file__).parents[3] / "examples" / "udp_coach.py"


class Program(asyncio.DatagramProtocol):
    """A coach program, written from docs/coach_programs.md."""

    def __init__(self) -> None:
        self.heard: list[dict[str, Any]] = []
        self.sequence = 0
        self.session = ""

    def connection_made(self, transport: Any) -> None:
        self.transport = transport

    def datagram_received(self, data: bytes, addr: Any) -> None:
        self.heard.append(json.loads(data))

    def send(self, kind: str, sequence: int | None = None, **words: Any) -> int:
        if sequence is None:
            self.sequence = sequence = self.sequence + 1
        said = {"kind": kind, "sequence": sequence, **words} | ({"session": self.session} if self.session else {})
        self.transport.sendto(json.dumps(said).encode())
        return sequence

    def of(self, kind: str) -> list[dict[str, Any]]:
        return [one for one in self.heard if one["kind"] == kind]

    def frame(self) -> dict[str, Any]:
        """The newest; empty before the first."""
        return self.of("frame")[-1] if self.of("frame") else {}

    def acks(self, sequence: int) -> list[dict[str, Any]]:
        return [one for one in self.of("ack") if one["sequence"] == sequence]


@asynccontextmanager
async def served(real: bool = False) -> Any:
    """Coach programs beside a host, which is a real one if that is wanted, and a way to have programs come."""
    async with (kicked_off if real else opened)() as bench:
        server = UdpServer(
            bench.live, TOKENS.role_of, bench.logged.append, bound_socket("--udp", LOOPBACK, 0, socket.SOCK_DGRAM)
        )
        bench.start(server)
        await until(lambda: server.port)
        programs: list[Program] = []

        async def come(role: str, **words: Any) -> Program:
            loop = asyncio.get_running_loop()
            _, program = await loop.create_datagram_endpoint(Program, remote_addr=("127.0.0.1", server.port))
            programs.append(program)
            first = program.send("hello", token=f"{role}-token", **words)
            await until(lambda: program.acks(first))
            (ack,) = program.acks(first)
            assert ack["accepted"], ack
            program.session = ack["session"]
            return program

        try:
            yield bench, server, come
        finally:
            await bench.end()
            await asyncio.sleep(0.01)
            for program in programs:
                program.transport.close()


async def test_each_order_reaches_every_robot_of_the_side() -> None:
    """In the paper, the coach's socket reached one robot only."""

    async with served(real=True) as (bench, _, come):
        program = await come("cyan")
        numbers = []
        for speed in (1.0, 2.0, 3.0):
            asked = program.send("order", order={"mode": "hold", "max_speed": speed})
            await until(lambda asked=asked: program.acks(asked))
            (ack,) = program.acks(asked)
            assert ack["accepted"], ack
            assert set(ack["acknowledged"]) | set(ack["missing"]) == {"cyan1", "cyan2"}
            numbers.append(ack["order"])
            expected = {"order": ack["order"], "acknowledged": {"cyan1": True, "cyan2": True}, "refused": {}}
            await until(lambda expected=expected: program.frame().get("orders", {}).get("cyan") == expected)
        brains = bench.stage.brains
        for robot in ("cyan1", "cyan2"):
            assert [order.max_speed for order in brains[robot].orders] == [1.0, 2.0, 3.0]
            assert [order.sequence for order in brains[robot].orders] == numbers
        assert brains["magenta1"].orders == []


async def test_several_coaches_stop_each_its_own_side() -> None:
    """In simatch, the stop of cyan's coach counts for both teams."""

    async with served(real=True) as (bench, _, come):
        brains = bench.stage.brains
        cyan, magenta = await come("cyan"), await come("magenta")
        magenta.send("match_mode", mode="stop")
        await until(lambda: brains["magenta1"].orders)
        assert [order.mode for order in brains["magenta1"].orders] == [CoachMode.HOLD]
        assert brains["cyan1"].orders == []
        cyan.send("match_mode", mode="stop")
        await until(lambda: brains["cyan1"].orders and brains["cyan2"].orders)
        assert len(brains["magenta1"].orders) == 1


async def test_a_program_receives_game_events_and_the_beliefs_of_its_own_robots() -> None:
    async with served() as (bench, _, come):
        cyan, referee = await come("cyan"), await come("referee")
        bench.stage.say(phase=Phase.CORNER, side=Side.MAGENTA)
        for robot in ("cyan2", "magenta1"):
            bench.stage.believe(robot, Radio(self=Motion(x=1.0, y=2.0, heading=0.5), intention="wait"))
        bench.stage.tell("something happens")
        await until(lambda: len(referee.of("belief")) == 2 and referee.of("event") and cyan.of("event"))
        await until(lambda: cyan.frame().get("match_mode") == {"cyan": "their_corner", "magenta": "our_corner"})
        assert [one["belief"]["robot"] for one in cyan.of("belief")] == ["cyan2"]
        assert cyan.of("belief")[0]["belief"]["radio"]["self"]["x"] == 1.0
        assert [one["event"]["text"] for one in cyan.of("event")] == ["something happens"]
        frame = cyan.frame()
        assert frame["host"] and frame["state"]["phase"] == "corner" and frame["events"] == 1


async def test_a_program_receives_the_obstacles_that_its_own_team_believes() -> None:
    async with served() as (bench, _, come):
        cyan, referee = await come("cyan"), await come("referee")
        bench.stage.believe("cyan2", Radio(self=Motion(x=1.0, y=2.0, heading=0.5), obstacles=[Point(x=3.0, y=1.0)]))
        bench.stage.believe("magenta1", Radio(obstacles=[Point(x=-4.0, y=0.0)]))
        bench.stage.show()
        await until(lambda: len(referee.frame().get("obstacles", {}).get("magenta", [])) == 1)
        await until(lambda: cyan.frame().get("obstacles", {}).get("cyan"))
        (seen,) = cyan.frame()["obstacles"]["cyan"]
        assert (seen["x"], seen["y"], seen["seen_by"]) == (3.0, 1.0, ["cyan2"])
        assert list(cyan.frame()["obstacles"]) == ["cyan"]
        await until(lambda: any(one["belief"]["radio"]["obstacles"] for one in cyan.of("belief")))


async def test_a_program_receives_a_bye_when_the_gateway_ends() -> None:
    async with served() as (bench, _, come):
        cyan, referee = await come("cyan"), await come("referee")
        bench.stop.set()
        await until(lambda: cyan.of("bye") and referee.of("bye"))
        assert cyan.of("bye") == [{"kind": "bye", "reason": "the gateway is shutting down"}]


async def test_frames_come_at_a_steady_rate_with_numbers_that_show_losses() -> None:
    async with served() as (_, _, come):
        slow, fast = await come("cyan", rate=5), await come("cyan", rate=50)
        await until(lambda: len(slow.of("frame")) >= 5)
        for program in (slow, fast):
            numbers = [one["number"] for one in program.of("frame")]
            assert numbers == list(range(1, len(numbers) + 1))
        assert len(fast.of("frame")) > len(slow.of("frame"))


async def test_an_event_that_was_lost_can_be_asked_for() -> None:
    async with served() as (bench, _, come):
        program = await come("cyan")
        for number in range(5):
            bench.stage.tell(f"event {number}")
        await until(lambda: len(program.of("event")) == 5)
        program.heard.clear()
        program.send("events", since=3)
        await until(lambda: len(program.of("event")) == 2)
        assert [(one["number"], one["event"]["text"]) for one in program.of("event")] == [
            (3, "event 3"),
            (4, "event 4"),
        ]


async def test_many_past_events_are_sent_frame_by_frame_and_completely() -> None:
    async with served() as (bench, _, come):
        for number in range(170):
            bench.stage.tell(f"event {number}")
        await until(lambda: len(bench.live.follower.events) == 170)
        program = await come("cyan", rate=50)
        await until(lambda: len(program.of("event")) == 170)
        assert [one["number"] for one in program.of("event")] == list(range(170))
        kinds = "".join("e" if one["kind"] == "event" else " " for one in program.heard).split()
        assert max(map(len, kinds)) <= 50


async def test_the_events_of_another_host_are_sent_from_their_beginning() -> None:
    async with served() as (bench, _, come):
        program = await come("cyan", rate=1)  # so seldom that both hosts speak between two frames
        for number in range(5):
            bench.stage.tell(f"old {number}")
        await until(lambda: len(program.of("event")) == 5)
        bench.stage.bus.close()
        another = type(bench.stage)(bench.stage.medium, bench.stage.config)
        bench.start(another)
        for number in range(3):
            another.tell(f"new {number}")
        await until(lambda: len(program.of("event")) == 8)
        told = [(one["number"], one["event"]["text"]) for one in program.of("event")]
        assert told[5:] == [(0, "new 0"), (1, "new 1"), (2, "new 2")]


async def test_the_referees_program_acts_or_receives_the_reason_of_a_refusal() -> None:
    async with served() as (bench, _, come):
        program = await come("referee", name="whistle")
        taken = program.send("match_mode", mode="our_corner", side="magenta")
        await until(lambda: program.acks(taken))
        assert program.acks(taken)[0]["accepted"]
        bench.stage.answer = lambda action: ActionReply(accepted=False, reason=f"{action.action}: not now")
        refused = program.send("action", action={"action": "penalty", "side": "cyan"})
        invalid = program.send("order", side="cyan", order={"mode": "hold", "robot_a": "magenta1"})
        await until(lambda: program.acks(refused) and program.acks(invalid))
        (penalty,), (order,) = program.acks(refused), program.acks(invalid)
        assert not penalty["accepted"] and penalty["reason"] == "penalty: not now"
        assert not order["accepted"] and "no robot of cyan" in order["reason"]
        assert [(one.action.value, one.side, one.source) for one in bench.stage.asked] == [
            ("corner", Side.MAGENTA, "coach program whistle"),
            ("penalty", Side.CYAN, "coach program whistle"),
        ]


async def test_garbage_and_a_program_that_never_reads_stop_no_other_program() -> None:
    async with served() as (_, server, come):
        deaf = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        deaf.connect(("127.0.0.1", server.port))
        deaf.send(json.dumps({"kind": "hello", "sequence": 1, "token": "magenta-token", "rate": 50}).encode())
        for data in (b"", b"\x00" * 60_000, b"[" * 9000, b"noise"):
            deaf.send(data)
        program = await come("cyan")
        await until(lambda: len(program.of("frame")) > 20)
        asked = program.send("order", order={"mode": "hold"})
        await until(lambda: program.acks(asked))
        deaf.close()
        await until(lambda: len(program.of("frame")) > 40)  # the closed port stops no other program


async def test_a_program_that_falls_silent_receives_the_end_of_its_session(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(session_module, "SILENCE_S", 1000.0)

    async with served() as (_, server, come):
        quiet, lively = await come("cyan"), await come("magenta")
        sessions = server._coaches.sessions
        sessions[quiet.transport.get_extra_info("sockname")].heard_at -= 1001.0
        await until(lambda: quiet.of("bye"))
        assert len(sessions) == 1 and not lively.of("bye")
        frames = len(quiet.of("frame"))
        asked = quiet.send("alive")
        await until(lambda: quiet.acks(asked))
        assert "unknown session" in quiet.acks(asked)[0]["reason"]
        assert len(quiet.of("frame")) == frames


async def test_the_example_coaches_a_side_with_nothing_but_pythons_own_library() -> None:
    async with served() as (bench, server, _):
        bench.stage.say(phase=Phase.PLAY, running=True)
        bench.stage.believe("cyan2", Radio(self=Motion(x=1.0, y=2.0, heading=0.5), intention="wait"))
        standing = bench.stage.bus.publisher(ACTIVE_ORDER, side="cyan")

        async def acknowledge() -> None:
            said = 0
            while True:
                await asyncio.sleep(0.01)
                for _, order in bench.stage.given_orders[said:]:
                    told = {f"cyan{number}": True for number in (1, 2, 3)}
                    standing.put(ActiveOrder(tick=1, time=0.0, order=order, acknowledged=told))
                    said += 1

        robots = asyncio.create_task(acknowledge())
        command = [sys.executable, str(EXAMPLE), "--port", str(server.port), "--token", "cyan-token"]
        run = await asyncio.create_subprocess_exec(
            *command, "--seconds", "0.3", stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
        output = (await run.communicate())[0].decode()
        robots.cancel()
        assert run.returncode == 0, output
        lines = output.splitlines()
        assert lines[0] == "coach of cyan"
        assert "order mode hold: acknowledged by all" in lines
        assert any(line.startswith("a corner for us: our_corner is for the referee alone") for line in lines)
        assert "cyan2 at 1.00, 2.00, wait" in lines
        given: list[CoachOrder] = [order for _, order in bench.stage.given_orders]
        assert [order.mode.value for order in given] == ["hold", "play", "test", "play"]
