"""The page's files: right types, strict headers, nothing beside them, and nothing for another site."""

import http.client
from collections.abc import Callable, Iterator
from http.client import HTTPResponse
from pathlib import Path

import pytest

from support.page_gateway import SOON, Gateway

Get = Callable[..., tuple[HTTPResponse, bytes]]


@pytest.fixture
def result(tmp_path: Path, tokens: Path) -> Path:
    """A folder of results, in which a link leads to the tokens."""
    folder = tmp_path / "served"
    folder.mkdir()
    (folder / "statistics.html").write_text("<script>1</script>")
    (folder / "link.json").symlink_to(tokens)
    return folder


@pytest.fixture
def gateway(gateway_of: Callable[..., Gateway], result: Path) -> Gateway:
    return gateway_of(result=result)


@pytest.fixture
def get(gateway: Gateway) -> Iterator[Get]:
    connection = http.client.HTTPConnection("127.0.0.1", gateway.port, timeout=SOON)

    def fetch(path: str, method: str = "GET", **headers: str) -> tuple[HTTPResponse, bytes]:
        connection.request(method, path, headers=headers)
        response = connection.getresponse()
        return response, response.read()

    yield fetch
    connection.close()


def test_a_match_that_is_not_over_has_no_result(get: Get, result: Path) -> None:
    result.rename(result.with_name("later"))
    assert get("/result/statistics.html")[0].status == 404


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("/", "text/html"),
        ("/main.js", "text/javascript"),
        ("/shared/pitch.js", "text/javascript"),
        ("/page.css", "text/css"),
        ("/result/statistics.html", "text/html"),
        ("/missing", "text/plain"),
    ],
)
def test_a_file_has_its_type_and_lets_a_browser_load_nothing_from_elsewhere(path: str, kind: str, get: Get) -> None:
    response, body = get(path)
    assert response.status == (404 if path == "/missing" else 200) and body
    assert response.headers["content-type"].startswith(kind)
    policy = response.headers["content-security-policy"]
    for forbidden in ("default-src", "frame-ancestors", "form-action", "base-uri"):
        assert f"{forbidden} 'none'" in policy
    assert "*" not in policy and "http" not in policy
    assert ("sandbox allow-scripts" in policy) == ("unsafe-inline" in policy) == path.startswith("/result/")
    assert response.headers["x-content-type-options"] == "nosniff"
    assert response.headers["referrer-policy"] == "no-referrer"
    assert response.headers["cache-control"] == "no-cache"
    assert "server" not in response.headers and "set-cookie" not in response.headers


def test_a_request_for_another_host_gets_no_file(get: Get) -> None:
    refused, body = get("/page.css", Host="evil.example")
    assert refused.status == 421 and b"--allow-origin" in body
    assert "default-src 'none'" in refused.headers["content-security-policy"]


@pytest.mark.parametrize(
    "path",
    [
        "/tokens.json",
        "/../protocol.py",
        "/%2e%2e/protocol.py",
        "/..%2f..%2ftokens.json",
        "/%252e%252e/tokens.json",
        "//etc/passwd",
        "/result/../tokens.json",
        "/result/link.json",
        "/shared/../../access/tokens.py",
        "/main.js%00.css",
        "/..%5c..%5ctokens.json",
        "/result/" + "a" * 5000,
        "/ws",
    ],
)
def test_nothing_beside_the_page_is_served(path: str, get: Get) -> None:
    response, body = get(path)
    assert response.status == 404 and b"the-referee" not in body


def test_files_can_be_read_and_nothing_else(get: Get) -> None:
    for method in ("POST", "PUT", "DELETE", "OPTIONS"):
        response, _ = get("/", method, Origin="http://evil.example")
        assert response.status == 405 and "access-control-allow-origin" not in response.headers
