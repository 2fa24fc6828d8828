"""The network namespaces of the tests: machines, cables, and links with delay and loss."""

import socket
import subprocess
import sys
import time

import pytest

from support.link_emulator import Direction, LinkConditions
from support.namespaces import Network, network

pytestmark = pytest.mark.processes

_ECHO = """
import socket, sys
server = socket.create_server((sys.argv[1], 7447), family=socket.AF_INET6 if ":" in sys.argv[1] else socket.AF_INET)
print(flush=True)
while True:
    link, _ = server.accept()
    while data := link.recv(65536):
        link.sendall(data)
"""


def _start_echo(net: Network, name: str, address: str) -> None:
    program = net.run(name, [sys.executable, "-c", _ECHO, address], stdout=subprocess.PIPE)
    assert program.stdout is not None
    program.stdout.readline()


def _received(link: socket.socket, count: int) -> bool:
    """Whether that many bytes come."""
    link.settimeout(60.0)
    while count > 0 and (data := link.recv(65_536)):
        count -= len(data)
    return count == 0


def _sent(data: bytes, conditions: LinkConditions) -> tuple[list[bytes], float]:
    """The frames of one byte that arrive of these, and when the last does, in s after they were sent."""
    way = Direction(0)
    way.set(conditions)
    for number in data:
        way.take(bytes([number]), 0.0)
    arrived, last = [], 0.0
    while (due := way.next_due()) is not None:
        arrived += way.due(due)
        last = due
    return arrived, last


def test_a_cut_cable_carries_nothing_until_it_is_restored() -> None:
    with network("host", "cyan") as net:
        _start_echo(net, "host", net.address("host"))
        with net.connect("cyan", net.address("host"), 7447) as link:
            for cut, restore in ((net.cut, net.restore), (net.interface_down, net.interface_up)):
                cut("cyan")
                link.sendall(b"a")
                link.settimeout(0.3)
                with pytest.raises(TimeoutError):
                    link.recv(1)
                restore("cyan")
                link.settimeout(60.0)
                assert link.recv(1) == b"a"


def test_an_impaired_link_delays_and_delivers() -> None:
    with network("host", "cyan") as net:
        _start_echo(net, "host", net.address("host"))
        net.impair("cyan", LinkConditions(delay_ms=30.0, jitter_ms=5.0, loss=0.02))
        with net.connect("cyan", net.address("host"), 7447) as link:
            begin = time.monotonic()
            link.sendall(b"x" * 200_000)
            assert _received(link, 200_000)
            assert time.monotonic() - begin >= 0.05


def test_jitter_keeps_the_order_and_reordering_changes_it() -> None:
    data = bytes(range(250))
    in_order = [bytes([number]) for number in data]
    jittery, last = _sent(data, LinkConditions(delay_ms=20.0, jitter_ms=10.0))
    assert jittery == in_order
    assert 0.02 < last <= 0.03
    mixed, _ = _sent(data, LinkConditions(delay_ms=20.0, reordering=0.1))
    assert sorted(mixed) == in_order
    assert mixed != in_order
