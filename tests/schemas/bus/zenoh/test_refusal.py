"""Why a host refuses a client, in one line: password, credentials, certificate, TLS, or no room."""

import re
import socket
import threading
from collections.abc import Iterator
from contextlib import ExitStack
from datetime import UTC, datetime
from pathlib import Path

import pytest
import trustme

from schemas.access.accounts import Account
from schemas.access.certificates import LOOPBACK_NAMES, Certificate, make_certificate
from schemas.access.credentials import account_file, new_credentials, write_credentials
from schemas.access.protection import Protection
from schemas.bus.contract import BusError, PresenceKind, RefusedClientError
from schemas.bus.zenoh.bus import ZenohBus, open_client, open_host
from schemas.bus.zenoh.handshake_tap import close_reason, has_opened, is_zenoh, message_kinds
from schemas.errors import TouchlineError
from schemas.process.clock import WallClock
from schemas.side import Side

ROBOTS = {side: [f"{side.value}1"] for side in Side}
PATIENCE = 20.0
"""s after which a client that waits would give up; a refusal does not wait."""


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
    with pytest.raises(RefusedClientError) as error:
        open_client("cup", WallClock(), connect, PATIENCE, credentials)
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.mark.parametrize("certificate", [None, make_certificate()], ids=["tcp", "tls"])
def test_a_wrong_password_is_one_line_with_the_user(hosts: Hosts, certificate: Certificate | None) -> None:
    host = hosts.open("own", certificate)
    wrong = hosts.file("own").parent / "wrong.json"
    own = hosts.file("own").read_text()
    wrong.touch(0o600)
    wrong.write_text(re.sub(r'"password": "[^"]*"', f'"password": "{"x" * 43}"', own))
    assert refusal(host.endpoint, wrong).startswith(
        f'user or password refused by the host at {host.endpoint} (user "cyan")'
    )
    with open_client("cup", WallClock(), host.endpoint, PATIENCE, hosts.file("own")) as client:
        assert client.connected()


def test_a_client_without_credentials_is_told_how_to_name_them(hosts: Hosts) -> None:
    line = refusal(hosts.open("own").endpoint, None)
    assert "admits only clients with credentials" in line and "TOUCHLINE_CREDENTIALS" in line


def test_credentials_for_a_host_that_has_none_are_reported(hosts: Hosts) -> None:
    hosts.open("own")
    assert "is open, without credentials" in refusal(hosts.open_to_all().endpoint, hosts.file("own"))


def test_a_host_without_room_is_no_wrong_password(hosts: Hosts) -> None:
    host = hosts.open("own", **{"transport/unicast/max_sessions": 1})
    with open_client("cup", WallClock(), host.endpoint, PATIENCE, hosts.file("own", Account.VIEWER)):
        assert "as many connections as it allows" in refusal(host.endpoint, hosts.file("own"))


def test_no_host_is_no_refusal(hosts: Hosts) -> None:
    hosts.open("own")
    with pytest.raises(BusError, match="no host answers there"):
        open_client("cup", WallClock(), "tcp/127.0.0.1:9", 0.0, hosts.file("own"))


def test_a_port_of_another_program_is_no_refusal(hosts: Hosts) -> None:
    hosts.open("own")
    with socket.create_server(("127.0.0.1", 0)) as server:

        def reply() -> None:
            while True:
                try:
                    link, _ = server.accept()
                except OSError:
                    return
                with link:
                    link.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")

        thread = threading.Thread(target=reply)
        thread.start()
        try:
            with pytest.raises(BusError, match="no host answers there"):
                open_client("cup", WallClock(), f"tcp/127.0.0.1:{server.getsockname()[1]}", 0.0, hosts.file("own"))
        finally:
            server.shutdown(socket.SHUT_RDWR)
            thread.join()


def test_plain_tcp_to_a_host_with_tls_is_reported(hosts: Hosts) -> None:
    host = hosts.open("own", make_certificate())
    hosts.open("plain")
    tcp = host.endpoint.replace("tls/", "tcp/")
    for credentials in (None, hosts.file("plain")):
        assert f"the host at {tcp} speaks TLS" in refusal(tcp, credentials)


def test_tls_to_a_plain_host_is_reported(hosts: Hosts) -> None:
    host = hosts.open("plain")
    hosts.open("own", make_certificate())
    assert "speaks no TLS" in refusal(host.endpoint, hosts.file("own"))


def test_a_client_with_a_root_certificate_uses_tls_where_tcp_is_written(hosts: Hosts) -> None:
    host = hosts.open("own", make_certificate())
    plain = host.endpoint.replace("tls/", "tcp/")
    with open_client("cup", WallClock(), plain, PATIENCE, hosts.file("own")) as client:
        assert client.endpoint == host.endpoint


def test_a_certificate_of_another_authority_is_reported(hosts: Hosts) -> None:
    host = hosts.open("own", make_certificate())
    hosts.open("other", make_certificate())
    assert "is of another authority than that of --credentials" in refusal(host.endpoint, hosts.file("other"))
    assert "is of an unknown authority" in refusal(host.endpoint, None)


def test_an_expired_certificate_is_reported(hosts: Hosts) -> None:
    root = trustme.CA()
    old = root.issue_cert(
        *LOOPBACK_NAMES, not_before=datetime(2001, 1, 1, tzinfo=UTC), not_after=datetime(2002, 1, 1, tzinfo=UTC)
    )
    chain, key = old.cert_chain_pems[0].bytes().decode(), old.private_key_pem.bytes().decode()
    host = hosts.open("own", Certificate(root=root.cert_pem.bytes().decode(), chain=chain, private_key=key))
    assert "has expired" in refusal(host.endpoint, hosts.file("own"))


def test_a_certificate_of_another_name_is_reported_with_the_option_that_adds_it(hosts: Hosts) -> None:
    root = trustme.CA()
    other = root.issue_cert("sim.example")
    chain, key = other.cert_chain_pems[0].bytes().decode(), other.private_key_pem.bytes().decode()
    host = hosts.open("own", Certificate(root=root.cert_pem.bytes().decode(), chain=chain, private_key=key))
    line = refusal(host.endpoint, hosts.file("own"))
    assert "is not for 127.0.0.1" in line and line.endswith("--host-name 127.0.0.1")


def test_credentials_of_another_match_are_refused_by_the_host() -> None:
    with pytest.raises(TouchlineError, match='for the match "final", not for "cup"; use --match final'):
        Protection.of(new_credentials("final"), "cup", ROBOTS)


def framed(*messages: bytes) -> bytes:
    return b"".join(len(message).to_bytes(2, "little") + message for message in messages)


def test_the_beginning_of_a_connection_is_read_as_far_as_it_is_a_handshake() -> None:
    initial, opening, closing = b"\xc1\x09", b"\xc2\x0a", b"\x03\x02"
    assert message_kinds(framed(initial, opening)) == [1, 2]
    assert has_opened(framed(initial, opening)) and not has_opened(framed(initial))
    assert (close_reason(framed(initial, closing)), close_reason(framed(initial))) == (2, None)
    assert not is_zenoh(b"HTTP/1.1 400") and not is_zenoh(b"") and not is_zenoh(b"\x15\x03\x03\x00\x02\x02\x32")
    assert message_kinds(framed(initial) + b"\x50\x00\x02") == [1]  # the second one is not whole
