"""What only the real network can show: addresses, a host that is late, gone, or back."""

import os
import socket
import subprocess
import sys
import textwrap
import threading
import time

import pytest

from runtime.bus.contract import BusError, PresenceKind
from runtime.bus.endpoint import is_loopback, parse_endpoint, with_free_port
from runtime.bus.zenoh import session
from runtime.bus.zenoh.bus import open_client, open_host
from runtime.process.clock import WallClock
from schemas.messages.command import Command
from schemas.topics import COMMAND


def test_a_port_in_use_is_one_line_with_the_remedy() -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("test", WallClock(), endpoint), pytest.raises(BusError) as error:
        open_host("test", WallClock(), endpoint)
    assert str(error.value).startswith(f"--listen {endpoint} is in use by another process; choose another port")
    assert "\n" not in str(error.value)


def test_a_host_on_a_free_port_knows_where_it_listens() -> None:
    with (
        open_host("test", WallClock(), "tcp/127.0.0.1:0") as host,
        open_host("test", WallClock(), "tcp/127.0.0.1:0") as other,
        open_client("test", WallClock(), host.endpoint) as client,
    ):
        assert host.endpoint != other.endpoint
        assert (client.endpoint, client.connected()) == (host.endpoint, True)


def test_a_host_without_an_endpoint_takes_the_default_one_or_a_free_one(monkeypatch: pytest.MonkeyPatch) -> None:
    default = with_free_port("tcp/127.0.0.1:0")
    monkeypatch.setattr(session, "DEFAULT_ENDPOINT", default)
    with open_host("test", WallClock()) as first, open_host("test", WallClock()) as second:
        assert first.endpoint == default
        assert second.endpoint.startswith("tcp/127.0.0.1:") and second.endpoint != default


def test_a_client_tries_again_within_its_patience() -> None:
    """The host begins to listen after the first attempt of its client has failed."""
    endpoint, hosts = with_free_port("tcp/127.0.0.1:0"), []

    class ClockOfAClient(WallClock):
        def sleep_until(self, when: float) -> None:
            if not hosts:
                hosts.append(open_host("test", WallClock(), endpoint))

    try:
        with open_client("test", ClockOfAClient(), endpoint, 60.0) as client:
            assert len(hosts) == 1 and client.connected()
    finally:
        for host in hosts:
            host.close()


def test_an_address_of_another_machine_is_one_line_with_the_remedy() -> None:
    with pytest.raises(
        BusError, match=r"^--listen tcp/192\.0\.2\.1:0 cannot be listened on \(.*\); choose another address$"
    ):
        open_host("test", WallClock(), "tcp/192.0.2.1:0")


def test_a_protocol_without_connections_has_no_free_port() -> None:
    with pytest.raises(BusError, match="udp has no free port to take; name a port, or use tcp"):
        open_host("test", WallClock(), "udp/127.0.0.1:0")


def test_a_client_without_a_name_joins_the_match_that_its_host_plays() -> None:
    with open_host("cup", WallClock(), "tcp/127.0.0.1:0") as host:
        host.declare_alive(PresenceKind.HOST, "host")
        with open_client(None, WallClock(), host.endpoint) as client:
            assert client.match == "cup"


def test_a_client_for_any_match_waits_until_its_host_is_present() -> None:
    """A router accepts clients before its host says what it plays; a wrong name would be kept, and heard by nobody."""
    with open_host("cup", WallClock(), "tcp/127.0.0.1:0") as host:
        present = threading.Timer(0.5, host.declare_alive, (PresenceKind.HOST, "host"))
        present.start()
        with open_client("final", WallClock(), host.endpoint, any_match=True) as client:
            assert client.match == "cup"
        present.join()


def test_an_endpoint_where_no_match_is_played_is_one_line_with_the_remedy() -> None:
    with open_host("cup", WallClock(), "tcp/127.0.0.1:0") as host, pytest.raises(BusError) as error:
        open_client(None, WallClock(), host.endpoint, patience=0.0)
    assert str(error.value) == (
        f"--connect {host.endpoint}: no match is played there; start one with `touchline match`"
    )


def test_a_client_goes_on_after_its_host_was_killed_and_came_back() -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    host = open_host("test", WallClock(), endpoint)
    with open_client("test", WallClock(), endpoint) as client:
        writer = client.publisher(COMMAND, robot="cyan1")
        host.close()
        writer.put(Command(answers_tick=0))  # into the void: nothing raises
        with open_host("test", WallClock(), endpoint) as again:
            commands = again.subscribe(COMMAND)
            deadline = time.monotonic() + 20.0
            heard = None
            while heard is None and time.monotonic() < deadline:
                writer.put(Command(answers_tick=1))
                heard = commands.receive(0.1)
    assert heard is not None and heard.message().answers_tick == 1


def test_the_threads_of_one_process_are_not_handed_on_to_those_it_launches(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ZENOH_RUNTIME", raising=False)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("test", WallClock(), endpoint), open_client("test", WallClock(), endpoint):
        assert "ZENOH_RUNTIME" not in os.environ


def test_a_process_that_forgets_to_close_its_bus_ends_all_the_same() -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    code = f"""
    from threading import Thread
    from runtime.bus.zenoh.bus import open_client, open_host
    from runtime.process.clock import WallClock
    from schemas.topics import ACTION, COMMAND
    bus = open_host("test", WallClock(), {endpoint!r})
    commands = bus.subscribe(COMMAND)
    commands.receive(0.01)
    bus.serve(ACTION)
    Thread(target=commands.receive, daemon=True).start()
    client = open_client("test", WallClock(), {endpoint!r})
    watch = client.watch_alive()
    client.declare_alive("robot", "cyan1")
    raise SystemExit(7)
    """
    ended = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], timeout=60, check=False)
    assert ended.returncode == 7


@pytest.mark.parametrize(
    ("endpoint", "loopback"),
    [
        ("tcp/127.0.0.1:7447", True),
        ("tcp/[::1]:7447", True),
        ("tcp/localhost:7447", True),
        ("tcp/0.0.0.0:7447", False),
        ("tcp/[::]:7447", False),
        ("tcp/192.0.2.7:7447", False),
        ("tls/simhost:7447", False),
    ],
)
def test_an_endpoint_knows_whether_others_can_reach_it(endpoint: str, loopback: bool) -> None:
    assert is_loopback(endpoint) is loopback


@pytest.mark.parametrize(
    "endpoint", ["7447", "tcp/127.0.0.1", "tcp/127.0.0.1:70000", "http/127.0.0.1:80", "tcp/a..b:7447", ""]
)
def test_an_endpoint_that_is_none_is_named(endpoint: str) -> None:
    with pytest.raises(BusError, match="write it as tcp/127"):
        parse_endpoint(endpoint)


def test_only_a_port_of_zero_is_replaced() -> None:
    assert with_free_port("tcp/127.0.0.1:7447") == "tcp/127.0.0.1:7447"
    assert parse_endpoint(with_free_port("tcp/127.0.0.1:0"))[2] != 0


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a port is free only at the moment it is chosen")
def test_a_port_that_was_chosen_stays_free_for_the_host_however_long_that_takes_to_start() -> None:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    _, host, port = parse_endpoint(endpoint)
    with socket.socket() as other, pytest.raises(OSError, match="in use"):
        other.bind((host, port))
    with open_host("test", WallClock(), endpoint), open_client("test", WallClock(), endpoint) as client:
        assert client.connected()
