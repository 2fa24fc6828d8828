"""A client that its host refuses learns in one line what to check."""

import re
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from runtime.access.accounts import Account
from runtime.access.certificates import Certificate, make_certificate
from runtime.access.credentials import account_file, new_credentials, write_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import BusError, PresenceKind
from runtime.bus.zenoh.bus import ZenohBus, open_client, open_host
from runtime.process.clock import WallClock
from schemas.side import Side

ROBOTS = {side: [f"{side.value}1"] for side in Side}
PATIENCE = 20.0


class Hosts:
    """Opens hosts, each with credentials of its own in a folder of its name."""

    def __init__(self, folder: Path, stack: ExitStack) -> None:
        self._folder, self._stack = folder, stack

    def open(self, name: str, certificate: Certificate | None = None, **limits: object) -> ZenohBus:
        credentials = new_credentials(certificate=certificate)
        write_credentials(self._folder / name, credentials)
        protection = Protection.of(credentials, "cup", ROBOTS)
        bus = open_host("cup", WallClock(), "tcp/127.0.0.1:0", protection, limits)
        bus.declare_alive(PresenceKind.HOST, "host")
        return self._stack.enter_context(bus)

    def open_to_all(self) -> ZenohBus:
        return self._stack.enter_context(open_host("cup", WallClock(), "tcp/127.0.0.1:0"))

    def file(self, name: str, account: Account = Account.CYAN) -> Path:
        return account_file(self._folder / name, account)


@pytest.fixture
def hosts(tmp_path: Path) -> Iterator[Hosts]:
    with ExitStack() as stack:
        yield Hosts(tmp_path, stack)


def refusal(connect: str, credentials: Path | None) -> str:
    with pytest.raises(BusError) as error:
        open_client("cup", WallClock(), connect, 0.0, credentials)
    line = str(error.value)
    assert line.startswith(f"--connect {connect}: ") and "\n" not in line
    assert f"touchline health --doctor --connect {connect}" in line
    return line


@pytest.mark.parametrize("certificate", [None, make_certificate()], ids=["tcp", "tls"])
def test_a_wrong_password_is_one_line_with_the_user(hosts: Hosts, certificate: Certificate | None) -> None:
    host = hosts.open("own", certificate)
    wrong = hosts.file("own").parent / "wrong.json"
    own = hosts.file("own").read_text()
    wrong.touch(0o600)
    wrong.write_text(re.sub(r'"password": "[^"]*"', f'"password": "{"x" * 43}"', own))
    line = refusal(host.endpoint, wrong)
    assert 'does not admit the user "cyan"' in line and "check --credentials" in line
    with open_client("cup", WallClock(), host.endpoint, PATIENCE, hosts.file("own")) as client:
        assert client.connected()


def test_a_client_without_credentials_is_told_how_to_name_them(hosts: Hosts) -> None:
    line = refusal(hosts.open("own").endpoint, None)
    assert "does not admit a client without credentials" in line and "TOUCHLINE_CREDENTIALS" in line


@pytest.mark.parametrize("case", ["a host that is open to all", "no room", "another authority"])
def test_whatever_the_reason_is_no_client_is_told_that_the_host_needs_no_credentials(hosts: Hosts, case: str) -> None:
    tls = make_certificate() if case == "another authority" else None
    host = hosts.open("own", tls, **({"transport/unicast/max_sessions": 1} if case == "no room" else {}))
    hosts.open("other", make_certificate())
    if case == "a host that is open to all":
        line = refusal(hosts.open_to_all().endpoint, hosts.file("own"))
    elif case == "no room":
        with open_client("cup", WallClock(), host.endpoint, PATIENCE, hosts.file("own", Account.VIEWER)):
            line = refusal(host.endpoint, hosts.file("own"))
    else:
        line = refusal(host.endpoint, hosts.file("other"))
    assert "check --credentials: the file must be of the host's own set" in line


def test_no_host_is_no_refusal(hosts: Hosts) -> None:
    hosts.open("own")
    with pytest.raises(BusError, match="no host answers there"):
        open_client("cup", WallClock(), "tcp/127.0.0.1:9", 0.0, hosts.file("own"))


def test_a_client_with_a_root_certificate_uses_tls_where_tcp_is_written(hosts: Hosts) -> None:
    host = hosts.open("own", make_certificate())
    plain = host.endpoint.replace("tls/", "tcp/")
    with open_client("cup", WallClock(), plain, PATIENCE, hosts.file("own")) as client:
        assert client.endpoint == host.endpoint
