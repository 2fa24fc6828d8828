"""Attacks on the port of coach programs over real sockets: the gateway lives, answers no more than it got, goes on."""

import asyncio
import json
import random
import socket
from typing import Any

from coach_gateway.access.tokens import Tokens
from coach_gateway.udp.server import UdpServer
from support.gateway_bench import opened, until

TOKENS = Tokens("referee-token", "cyan-token", "magenta-token")


class Sender(asyncio.DatagramProtocol):
    """A socket that keeps what it receives."""

    def __init__(self) -> None:
        self.received: list[dict[str, Any]] = []
        self.bytes = 0

    def connection_made(self, transport: Any) -> None:
        self.transport = transport

    def datagram_received(self, data: bytes, addr: Any) -> None:
        self.bytes += len(data)
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
            source, sent = random.Random(7), 0
            for number in range(5000):
                data = source.randbytes(source.choice((0, 1, 20, 500, 8192, 8193, 60_000, 65_507)))
                flooder.transport.sendto(data)
                sent += len(data)
                if number % 100 == 0:
                    await asyncio.sleep(0)
            while not [one for one in program.received if one["kind"] == "ack" and one["sequence"] == 2]:
                program.send("action", 2, session=session, action={"action": "stop"})  # a full buffer may lose it
                await asyncio.sleep(0.05)
            frames = len([one for one in program.received if one["kind"] == "frame"])
            await until(lambda: len([one for one in program.received if one["kind"] == "frame"]) > frames + 5)
            assert bench.stage.asked[-1].action == "stop"
            assert flooder.bytes < sent and all(one["kind"] == "ack" for one in flooder.received)
            for one in (flooder, program):
                one.transport.close()
        lines = [line for line in bench.logged if line.startswith("coach programs: ")]
        assert len(lines) <= 3 and lines[-1].startswith("coach programs: refused ")

    asyncio.run(play())


def test_garbage_gets_no_more_bytes_than_it_had() -> None:
    async def play() -> None:
        async with opened() as bench:
            server = UdpServer(bench.live, TOKENS.role_of, bench.logged.append, port=0)
            bench.start(server)
            await until(lambda: server.port)
            contents = [b"{}", b"x", b'{"kind":"hello","sequence":1,"token":"wrong"}', b"y" * 100, b"z" * 9000]
            for number, content in enumerate(contents, 2):
                sender = await sender_to(server.port, f"127.0.0.{number}")
                for _ in range(20):
                    sender.transport.sendto(content)
                last = await sender_to(server.port, "127.0.0.99")
                while not last.received:  # all before it have been handled
                    last.send("hello", 1, token="cyan-token")
                    await asyncio.sleep(0.05)
                await asyncio.sleep(0)
                assert sender.bytes <= 20 * len(content)
                for one in (sender, last):
                    one.transport.close()
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as gone:  # its port is closed when the reply comes
                gone.sendto(b"q" * 500, ("127.0.0.1", server.port))
            assert not bench.tasks[-1].done()

    asyncio.run(play())
