"""Whom a page's room is counted for, and how much of it one address may take."""

from collections.abc import Callable

import pytest

from coach_gateway.access.client_network import client_network
from coach_gateway.web import socket_endpoint
from coach_gateway.web.pages import Page, Pages
from support.fake_host import FakeHost
from support.page_gateway import Gateway
from support.visitor import Visitor


@pytest.mark.parametrize(
    ("address", "network"),
    [
        ("192.0.2.7", "192.0.2.7"),
        ("::ffff:192.0.2.7", "192.0.2.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::"),
        ("fe80::1%eth0", "fe80::"),
        ("127.0.0.1", None),
        ("127.8.8.8", None),
        ("::1", None),
        ("::ffff:127.0.0.1", None),
        (None, None),
    ],
)
def test_pages_are_counted_by_address_or_network_and_those_of_this_machine_are_not(address, network):
    assert client_network(address) == network


def fill(pages: Pages, count: int, network: str | None) -> None:
    for _ in range(count):
        assert pages.why_no_room(network) == ""
        pages.enter(Page(None, None, 0.0, network))


def test_one_address_does_not_take_the_room_of_all_others():
    pages = Pages(300, 100)
    fill(pages, 100, "192.0.2.7")
    assert pages.why_no_room("192.0.2.7") == (
        "100 pages of your address are open; close one, or raise --pages-per-address"
    )
    fill(pages, 100, "192.0.2.8")
    pages.forget(next(page for page in pages if page.network == "192.0.2.7"))
    assert pages.why_no_room("192.0.2.7") == ""


def test_pages_of_this_machine_or_of_a_proxy_on_it_may_take_all_room():
    pages = Pages(300, 100)
    fill(pages, 300, None)
    assert "300 pages are open" in pages.why_no_room(None)


def test_a_page_refused_for_its_address_gets_the_reason_and_others_are_admitted(
    host: FakeHost, gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Addresses of loopback stand for those of other machines."""
    monkeypatch.setattr(socket_endpoint, "client_network", lambda address: address)
    gateway = gateway_of(pages_per_address=1)
    first, second = (Visitor(gateway.origin, source_address=("127.0.0.2", 0)) for _ in range(2))
    other = Visitor(gateway.origin, source_address=("127.0.0.3", 0))
    assert second.hear("refusal")["reason"].startswith("1 pages of your address are open")
    assert other.hear()["kind"] == first.hear()["kind"] == "welcome"
    assert "1 page refused for lack of room" in gateway.server.pages.fault_summary()
    for visitor in (first, second, other):
        visitor.close()
