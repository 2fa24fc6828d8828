"""The page's files: right types, strict headers, nothing beside them."""

import http.client
from collections.abc import Callable, Iterator
from http.client import HTTPResponse

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from support.page_gateway import SOON, Gateway


@pytest.fixture
def get(gateway_of: Callable[..., Gateway]) -> Iterator[Callable[..., tuple[HTTPResponse, bytes]]]:
    connection = http.client.HTTPConnection("127.0.0.1", gateway_of().port, timeout=SOON)

    def fetch(path: str, method: str = "GET", **headers: str) -> tuple[HTTPResponse, bytes]:
        connection.request(method, path, headers=headers)
        response = connection.getresponse()
        return response, response.read()

    yield fetch
    connection.close()


Get = Callable[..., tuple[HTTPResponse, bytes]]


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("/", "text/html"),
        ("/main.js", "text/javascript"),
        ("/shared/pitch.js", "text/javascript"),
        ("/page.css", "text/css"),
    ],
)
def test_a_file_has_its_type_and_lets_a_browser_load_nothing_from_elsewhere(path: str, kind: str, get: Get) -> None:
    response, body = get(path)
    assert response.status == 200
    assert body
    assert response.headers["content-type"].startswith(kind)
    policy = response.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "script-src 'self'" in policy
    assert "unsafe" not in policy
    assert "http" not in policy
    assert response.headers["x-content-type-options"] == "nosniff"
    assert response.headers["referrer-policy"] == "no-referrer"
    assert response.headers["cache-control"] == "no-cache"


def test_the_page_itself_has_neither_script_nor_style_inline(get: Get) -> None:
    text = get("/")[1].decode()
    assert "<style" not in text
    assert " style=" not in text
    assert "<script>" not in text
    assert "http://" not in text.replace("http://www.w3.org", "")
    assert "https://" not in text


def test_a_file_that_has_not_changed_is_not_sent_again(get: Get) -> None:
    first, _ = get("/page.css")
    again, body = get("/page.css", **{"If-None-Match": first.headers["etag"]})
    assert (again.status, body) == (304, b"")


@pytest.mark.parametrize("path", ["/tokens.json", "/../protocol.py", "/%2e%2e/protocol.py", "/..%2fprotocol.py", "/ws"])
def test_nothing_beside_the_page_is_served(path: str, get: Get) -> None:
    assert get(path)[0].status == 404


def test_files_can_be_read_and_nothing_else(get: Get) -> None:
    assert [get("/", method)[0].status for method in ("POST", "PUT", "DELETE")] == [405] * 3


def test_a_socket_at_another_door_is_refused(gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of()
    with pytest.raises(InvalidStatus), connect(f"ws://127.0.0.1:{gateway.port}/elsewhere", open_timeout=SOON):
        pass
