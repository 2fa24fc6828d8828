"""A flood on the port of coach programs over real sockets: the gateway lives and goes on."""

import asyncio
import json
import random
from typing import Any

from coach_gateway.access.tokens import Tokens
from coach_gateway.udp.server import UdpServer
from support.gateway_bench import opened, until

TOKENS = Tokens("referee-token", "cyan-token", "magenta-token")


class Sender(asyncio.DatagramProtocol):
    """A socket that keeps what it receives."""

    def __init__(self) -> None:
        self.received: list[dict[str, Any]] = []

    def connection_made(self, transport: Any) -> None:
        self.transport = transport

    def datagram_received(self, data: bytes, addr: Any) -> None:
        self.received.append(json.loads(data))

    def send(self, kind: str, sequence: int, **words: Any) -> None:
        self.transport.sendto(json.dumps({"kind": kind, "sequence": sequence, **words}).encode())


async def sender_to(port: int, source: str = "127.0.0.1") -> Sender:
    loop = asyncio.get_running_loop()
    _, sender = await loop.create_datagram_endpoint(Sender, remote_addr=("127.0.0.1", port), local_addr=(source, 0))
    return sender


def test_a_flood_of_garbage_of_all_sizes_changes_nothing_for_a_program() -> None:
    async def play() -> None:
        async with opened() as bench:
            server = UdpServer(bench.live, TOKENS.role_of, bench.logged.append, port=0)
            bench.start(server)
            await until(lambda: server.port)
            flooder, program = await sender_to(server.port), await sender_to(server.port)
            program.send("hello", 1, token="referee-token", rate=50)
            await until(lambda: program.received)
            session = program.received[0]["session"]
            source = random.Random(7)
            for number in range(5000):
                flooder.transport.sendto(source.randbytes(source.choice((0, 1, 20, 500, 8192, 8193, 60_000, 65_507))))
                if number % 100 == 0:
                    await asyncio.sleep(0)
            while not [one for one in program.received if one["kind"] == "ack" and one["sequence"] == 2]:
                program.send("action", 2, session=session, action={"action": "stop"})  # a full buffer may lose it
                await asyncio.sleep(0.05)
            frames = len([one for one in program.received if one["kind"] == "frame"])
            await until(lambda: len([one for one in program.received if one["kind"] == "frame"]) > frames + 5)
            assert bench.stage.asked[-1].action == "stop"
            assert all(one["kind"] == "ack" for one in flooder.received)
            for one in (flooder, program):
                one.transport.close()
        lines = [line for line in bench.logged if line.startswith("coach programs: ")]
        assert len(lines) <= 3 and lines[-1].startswith("coach programs: refused ")

    asyncio.run(play())
