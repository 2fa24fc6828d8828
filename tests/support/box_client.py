"""Our base station, connected to a referee box beside a host."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

from coach_gateway.soccer.refbox.client import BoxAddress, RefBoxClient
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side
from support.gateway_bench import Bench, opened, until
from support.referee_box import Box


@asynccontextmanager
async def connected(
    protocol: BoxProtocol = BoxProtocol.AUTO, team: Side = Side.CYAN, **box_is: Any
) -> AsyncIterator[tuple[Bench, Box, RefBoxClient]]:
    """A box, and a base station of ours that is connected to it, beside a host; `box_is` are arguments of the box."""
    async with opened() as bench:
        box = Box(**box_is)
        port = await box.open()
        client = RefBoxClient(bench.live, BoxAddress(team, "127.0.0.1", port, protocol), bench.logged.append)
        bench.start(client)
        try:
            await until(lambda: box.links and client.connected, "the connection, on both sides")
            yield bench, box, client
        finally:
            bench.stop.set()
            await box.close()
