"""The address of a page is printed when the page is served, and once."""

import socket

import pytest

from coach_gateway.web.settings import WebSettings
from touchline.launch.page_probe import AddressLines, PageProbe

ANSWER = b"HTTP/1.0 200 OK\r\n\r\n"


@pytest.fixture
def listener() -> socket.socket:
    return socket.create_server(("127.0.0.1", 0))


def test_a_page_is_served_when_it_answers_and_not_when_its_port_is_open(listener: socket.socket) -> None:
    port = int(listener.getsockname()[1])
    printed: list[str] = []
    address = AddressLines(WebSettings(port=port), lambda: [f"page: {port}"], printed.append)
    for _ in range(3):
        address.update()
    assert printed == []  # it listens, and has not answered yet
    link, _ = listener.accept()
    assert link.recv(100).startswith(b"GET /icon.svg")
    link.sendall(ANSWER)
    while not printed:
        address.update()
    for _ in range(3):
        address.update()
    assert printed == [f"page: {port}"]
    link.close()
    listener.close()


def test_an_attempt_that_is_cut_off_is_repeated(listener: socket.socket) -> None:
    probe = PageProbe(WebSettings(port=int(listener.getsockname()[1])))
    assert not probe.is_served()
    first, _ = listener.accept()
    first.close()
    listener.settimeout(5.0)
    served = False
    for _ in range(200):
        served = served or probe.is_served()
    second, _ = listener.accept()
    second.sendall(ANSWER)
    while not served:
        served = probe.is_served()
    second.close()
    listener.close()


def test_a_port_on_which_nothing_listens_is_not_served(listener: socket.socket) -> None:
    port = int(listener.getsockname()[1])
    listener.close()
    assert not PageProbe(WebSettings(port=port)).is_served()
