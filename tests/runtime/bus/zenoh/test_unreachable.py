"""A host that cannot be reached: the line names the cause, as far as this machine can know it."""

import socket

import pytest

from runtime.access.accounts import Account
from runtime.access.credentials import Credentials
from runtime.bus.contract import BusError
from runtime.bus.zenoh.bus import open_client
from runtime.bus.zenoh.unreachable import why_unreachable
from runtime.process.clock import WallClock


def refusing(error: type[OSError], *about: object):
    def connect(*_: object, **__: object) -> socket.socket:
        raise error(*about)

    return connect


def test_a_name_without_an_address_is_named():
    line = why_unreachable("tcp/simhost.invalid:7447")
    assert line.startswith('--connect tcp/simhost.invalid:7447: the name "simhost.invalid" has no address here (')
    assert line.endswith("give the host's address, or add the name to /etc/hosts")


def test_a_client_reports_the_cause_when_its_patience_ends():
    with pytest.raises(BusError, match=r'the name "simhost\.invalid" has no address here'):
        open_client("test", WallClock(), "tcp/simhost.invalid:7447", patience=0.0)


@pytest.mark.parametrize(
    ("connect", "words"),
    [
        (refusing(TimeoutError, "timed out"), "not even with a refusal"),
        (refusing(OSError, 113, "No route to host"), "no way there from this machine (No route to host)"),
        (refusing(ConnectionRefusedError, 111, "Connection refused"), "no host answers there"),
    ],
    ids=["a filtered port", "no route", "a closed port"],
)
@pytest.mark.parametrize("protocol", ["tcp", "tls"])
def test_the_cause_is_told_from_how_a_connection_fails(monkeypatch, connect, words, protocol):
    monkeypatch.setattr(socket, "create_connection", connect)
    line = why_unreachable(f"{protocol}/127.0.0.1:7447")
    assert words in line
    assert "\n" not in line


def test_a_connectionless_endpoint_is_not_tried():
    assert "no host answers there" in why_unreachable("udp/127.0.0.1:7447")


@pytest.mark.parametrize("account", [None, Account.RECORDER])
def test_a_listener_that_does_not_admit_is_told_with_who_was_refused_and_what_to_do(account):
    with socket.create_server(("127.0.0.1", 0)) as server:
        endpoint = f"tcp/127.0.0.1:{server.getsockname()[1]}"
        line = why_unreachable(endpoint, None if account is None else Credentials(user=account, password="x" * 16))
    who = 'the user "recorder"' if account else "a client without credentials"
    remedy = (
        "check --credentials: the file must be of the host" if account else "add --credentials FILE, or set TOUCHLINE"
    )
    assert line.startswith(
        f"--connect {endpoint}: what listens there does not admit {who}, or is no host that is ready; "
    )
    assert f"; {remedy}" in line and f"(`touchline health --doctor --connect {endpoint}` examines port" in line
