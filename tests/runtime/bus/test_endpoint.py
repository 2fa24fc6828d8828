"""Endpoints as text."""

import pytest

from runtime.bus.contract import BusError
from runtime.bus.endpoint import local_endpoint, with_tls


@pytest.mark.parametrize(
    ("listen", "local"),
    [
        ("tcp/0.0.0.0:7447", "tcp/127.0.0.1:7447"),
        ("tcp/[::]:7447", "tcp/[::1]:7447"),
        ("tcp/[fd00::7]:7447", "tcp/[fd00::7]:7447"),
        ("tls/192.0.2.1:7448", "tls/192.0.2.1:7448"),
        ("tcp/localhost:7447", "tcp/localhost:7447"),
    ],
)
def test_processes_of_one_machine_reach_a_listener_on_every_address_over_loopback(listen: str, local: str) -> None:
    assert local_endpoint(listen) == local


def test_tls_keeps_address_and_port_and_is_refused_where_there_is_none() -> None:
    assert with_tls("tcp/192.0.2.1:7447") == "tls/192.0.2.1:7447"
    assert with_tls("quic/[::1]:7447") == "quic/[::1]:7447"
    with pytest.raises(BusError, match=r"ws/127\.0\.0\.1:1: ws has no TLS"):
        with_tls("ws/127.0.0.1:1")
