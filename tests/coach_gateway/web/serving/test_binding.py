"""The socket that the page is served on."""

import asyncio
import socket

import pytest

from coach_gateway.web.serving.binding import listen


@pytest.mark.anyio
async def test_what_is_sent_to_a_page_does_not_wait_for_its_acknowledgement() -> None:
    """A file of a page has a head and a body: between both, Nagle's algorithm waits 40 ms."""
    option: asyncio.Future[int] = asyncio.get_running_loop().create_future()

    def meet(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        connection = writer.get_extra_info("socket")
        option.set_result(connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY))
        writer.close()

    with listen("127.0.0.1", 0) as listener:
        async with await asyncio.start_server(meet, sock=listener):
            _, writer = await asyncio.open_connection(*listener.getsockname())
            assert await option
            writer.close()
