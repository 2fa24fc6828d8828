"""Attacks on the page's port with connections: half-open, slow, too many, and HTTP that is none."""

import http.client
from collections.abc import Callable, Iterator

import pytest

from coach_gateway.web import connections, http_protocol, socket_protocol
from support.page_gateway import SOON, Gateway
from support.raw_client import RawClient, eventually
from support.visitor import Visitor

Open = Callable[..., RawClient]
HEAD = b"GET /page.css HTTP/1.1\r\nHost: 127.0.0.1\r\n"


@pytest.fixture
def gateway(gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch) -> Gateway:
    """Addresses of loopback stand for those of other machines."""
    for module in (http_protocol, socket_protocol):
        monkeypatch.setattr(module, "client_network", lambda address: address)
    return gateway_of()


@pytest.fixture
def open_raw(gateway: Gateway) -> Iterator[Open]:
    made: list[RawClient] = []

    def make(**words: object) -> RawClient:
        made.append(RawClient(gateway.port, **words))  # type: ignore[arg-type]
        return made[-1]

    yield make
    for client in made:
        client.close()


def fetch(gateway: Gateway, path: str = "/page.css", source: str = "127.0.0.9", **headers: str) -> tuple[int, bytes]:
    """A file as somebody else gets it."""
    other = http.client.HTTPConnection("127.0.0.1", gateway.port, timeout=SOON, source_address=(source, 0))
    other.request("GET", path, headers=headers)
    response = other.getresponse()
    body = response.read()
    other.close()
    return response.status, body


def test_half_open_connections_of_one_address_keep_nobody_else_out(gateway: Gateway, open_raw: Open) -> None:
    crowd = [open_raw(source="127.0.0.2") for _ in range(connections.MOST_WAITING + 50)]
    eventually(lambda: gateway.pages.counts["crowded"] >= 50)
    assert fetch(gateway)[0] == 200
    other = Visitor(gateway.origin, source_address=("127.0.0.9", 0))
    assert other.hear("welcome")["role"] == "spectator"
    other.close()
    assert sum(client.is_closed for client in crowd) >= 50
    assert gateway.logged == ["page: connection closed to make room from 127.0.0.2; further ones are counted"]


def test_a_request_that_drips_is_cut_off_while_it_still_drips(
    gateway: Gateway, open_raw: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(http_protocol, "REQUEST_S", 0.3)
    loris = open_raw()
    loris.send(HEAD)

    def drips() -> bool:
        loris.send(b"X: y\r\n")
        return loris.is_closed

    eventually(drips)
    assert gateway.pages.counts["late"] == 1
    silent, reused = open_raw(), open_raw()
    reused.send(HEAD + b"\r\n")
    assert b"200 OK" in reused.receive()
    eventually(lambda: silent.is_closed and reused.is_closed)  # as a browser's that were opened in advance
    assert gateway.pages.counts["late"] == 1


def test_a_handshake_that_drips_is_cut_off(gateway: Gateway, open_raw: Open, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(http_protocol, "REQUEST_S", 0.3)
    loris = open_raw()
    loris.send(b"GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n")
    eventually(lambda: loris.is_closed)
    assert gateway.pages.counts["late"] == 1


def test_a_client_that_does_not_read_its_file_is_cut_off(
    gateway: Gateway, open_raw: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(http_protocol, "RESPONSE_S", 0.3)
    deaf = open_raw(room=2048)
    deaf.send((HEAD + b"\r\n") * 200)
    eventually(lambda: gateway.pages.counts["late"] == 1)
    assert fetch(gateway)[0] == 200


def test_a_network_that_opens_connections_without_end_is_turned_away_and_others_are_not(
    gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(http_protocol, "client_network", lambda address: address)
    monkeypatch.setattr(connections, "NEW_AT_ONCE", 20.0)
    gateway = gateway_of()
    for _ in range(60):
        RawClient(gateway.port, "127.0.0.2").close()
    eventually(lambda: gateway.pages.counts["connections"] >= 20)
    assert fetch(gateway)[0] == 200


def test_a_network_that_requests_files_without_end_is_turned_away_and_others_are_not(
    gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(http_protocol, "client_network", lambda address: address)
    monkeypatch.setattr(connections, "REQUESTS_AT_ONCE", 20.0)
    gateway = gateway_of()
    flooder = RawClient(gateway.port, "127.0.0.2")
    flooder.send((HEAD + b"\r\n") * 500)
    flooder.receive_all()
    flooder.close()
    assert gateway.pages.counts["requests"] == 1
    assert fetch(gateway)[0] == 200


SMUGGLED = [
    b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\nGET /x",
    b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: -1\r\n\r\n",
    b"POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked, identity\r\n\r\n0\r\n\r\n",
    b"POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: xchunked\r\n\r\n0\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
    b"GET / HTTP/1.1\r\n\r\n",
    b"GET /\x00 HTTP/1.1\r\nHost: a\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost : a\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost: a\r\nX: \x00\r\n\r\n",
    b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(100) + b"\r\n\r\n",
    b"\r\n" * 40_000,
    b"GET / HTTP/1.1\r\nHost: a\r\nX: " + b"y" * 1_000_000 + b"\r\n\r\n",
]


def test_what_is_not_plain_http_gets_one_refusal_and_the_end_of_its_connection(
    gateway: Gateway, open_raw: Open
) -> None:
    for number, request in enumerate(SMUGGLED, 1):
        client = open_raw()
        client.send(request)
        assert client.receive_all().count(b"HTTP/1.1 ") <= 1, request[:60]
        eventually(lambda number=number: gateway.pages.counts["broken"] == number, repr(request[:60]))
    assert fetch(gateway)[0] == 200
    assert gateway.logged == [
        "page: connection that broke the protocol from 127.0.0.1 (not HTTP); further ones are counted"
    ]


def test_a_body_is_never_taken_for_a_second_request(gateway: Gateway, open_raw: Open) -> None:
    hidden = b"GET /main.js HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
    for length in (b"Content-Length: %d\r\n" % len(hidden), b"Transfer-Encoding: chunked\r\nContent-Length: 3\r\n"):
        client = open_raw()
        chunked = b"%x\r\n%s\r\n0\r\n\r\n" % (len(hidden), hidden)
        body = chunked if b"chunked" in length else hidden
        client.send(b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" + length + b"\r\n" + body)
        answer = client.receive_all()
        assert answer.count(b"HTTP/1.1 ") == 1 and b"javascript" not in answer, answer[:200]


def test_a_body_without_end_is_not_read(gateway: Gateway, open_raw: Open) -> None:
    client = open_raw()
    client.send(b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 4000000000\r\n\r\n")
    assert b"405" in client.receive()
    for _ in range(200):
        if not client.send(bytes(65_536)):
            break
    assert fetch(gateway)[0] == 200
