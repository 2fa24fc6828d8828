"""The links of a host's router: what a client has sent by its own, and how the host closes and refuses links."""

import socket
import struct
import time
from contextlib import suppress
from pathlib import Path

import pytest
import zenoh

from schemas.bus.contract import Bus
from schemas.bus.zenoh.bus import open_client, open_host
from schemas.messages.command import Command
from schemas.process.clock import WallClock
from schemas.process.open_sockets import duplicate
from schemas.topics import COMMAND
from support.attacker import open_session
from support.process_story import wait_for

pytestmark = [
    pytest.mark.timeout(120),
    pytest.mark.skipif(not hasattr(socket, "TCP_INFO"), reason="only Linux reports the bytes of a connection"),
]
LIMIT = 30.0


@pytest.fixture(params=["tcp/127.0.0.1:0", "tcp/[::]:0"])
def host(request):
    with open_host("linked", WallClock(), request.param) as bus:
        yield bus


def endpoint_of(host: Bus) -> str:
    return host.endpoint.replace("[::]", "127.0.0.1")


def client_of(host: Bus) -> Bus:
    return open_client("linked", WallClock(), endpoint_of(host))


def links_of(host: Bus, count: int):
    return wait_for(lambda: len(traffic := host.links.traffic()) == count and traffic, f"{count} links", LIMIT)


def test_a_host_sees_which_client_has_sent_how_much(host):
    with client_of(host) as quiet, client_of(host) as busy:
        quiet_id, busy_id = str(quiet.session.info.zid()), str(busy.session.info.zid())
        assert {link.address for link in links_of(host, 2)} == {"127.0.0.1"}
        writer, commands = busy.publisher(COMMAND, robot="cyan1"), host.subscribe(COMMAND)

        def sent():
            writer.put_payload(b"x" * 10_000)
            commands.receive()
            by_client = {link.client: size for link, size in host.links.traffic().items()}
            return by_client[busy_id] > 10**6 and by_client

        assert wait_for(sent, "a million bytes", LIMIT)[quiet_id] < 10_000


def test_no_end_of_a_link_waits_for_data_that_a_cut_network_cannot_take(host):
    """Zenoh would wait for 10 s for each link, and meanwhile admit nobody."""

    def lingers() -> dict[int, bool]:
        """Descriptor of each end of the host's connections → whether closing it waits."""
        found = {}
        for entry in Path("/proc/self/fd").iterdir():
            with suppress(OSError), duplicate(int(entry.name)) as connection:
                if connection.family in (socket.AF_INET, socket.AF_INET6):
                    ports = connection.getsockname()[1], connection.getpeername()[1]
                    if port in ports:
                        option = connection.getsockopt(socket.SOL_SOCKET, socket.SO_LINGER, 8)
                        found[int(entry.name)] = bool(struct.unpack("ii", option)[0])
        return found

    port = int(host.endpoint.rpartition(":")[2])

    with client_of(host):
        links_of(host, 1)
        wait_for(lambda: len(found := lingers()) == 2 and not any(found.values()), "two ends that do not wait", LIMIT)


def test_a_closed_link_is_that_client_s_alone_and_its_client_connects_again_by_itself(host):
    commands = host.subscribe(COMMAND)
    with client_of(host) as first, client_of(host) as second:
        links = {link.client: link for link in links_of(host, 2)}
        first_link, second_link = (links[str(one.session.info.zid())] for one in (first, second))
        assert host.links.close(first_link)
        wait_for(lambda: first_link not in host.links.traffic(), "the end of the link", LIMIT)
        assert second_link in host.links.traffic()
        writer = first.publisher(COMMAND, robot="cyan1")

        def arrives():
            writer.put(Command(answers_tick=0))
            return commands.receive(0.05)

        wait_for(arrives, "a command after the client has connected again", LIMIT)
        assert not host.links.close(first_link)


def test_a_refused_client_gets_no_link_and_others_do(host):
    refused = []

    def is_refused(link):
        if link.client == "abc":
            refused.append(link.address)
        return link.client == "abc"

    host.links.refuse_if(is_refused)
    commands = host.subscribe(COMMAND)
    deadline = time.monotonic() + LIMIT
    while not refused and time.monotonic() < deadline:
        try:
            open_session(endpoint_of(host), id="abc").close()
        except zenoh.ZError:
            continue
    assert refused[0] == "127.0.0.1"
    with client_of(host) as other:
        other.publisher(COMMAND, robot="cyan1").put(Command(answers_tick=0))
        assert commands.receive(LIMIT) is not None
        assert [link.client for link in links_of(host, 1)] == [str(other.session.info.zid())]
