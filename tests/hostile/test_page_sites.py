"""Attacks on the page from other sites and by addresses: forged names, foreign origins, frames, paths, leaks."""

import http.client
from collections.abc import Callable
from pathlib import Path

import pytest
from websockets.exceptions import InvalidStatus

from coach_gateway.access.origins import Origins
from coach_gateway.web.site import HEADERS
from support.page_gateway import SOON, Gateway
from support.raw_client import RawClient
from support.visitor import Visitor


def request(gateway: Gateway, path: str, method: str = "GET", **headers: str) -> http.client.HTTPResponse:
    """A response, with its body read."""
    connection = http.client.HTTPConnection("127.0.0.1", gateway.port, timeout=SOON)
    connection.putrequest(method, path, skip_host=True)
    for name, value in {"Host": f"127.0.0.1:{gateway.port}", **headers}.items():
        connection.putheader(name.replace("_", "-"), value)
    connection.endheaders()
    response = connection.getresponse()
    response.read()
    connection.close()
    return response


@pytest.fixture
def gateway(gateway_of: Callable[..., Gateway]) -> Gateway:
    return gateway_of()


@pytest.mark.parametrize(
    "host",
    ["evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example", "", "[", "a@b", "☃"],
)
def test_a_name_that_a_foreign_dns_entry_points_here_gets_no_file(gateway: Gateway, host: str) -> None:
    refused = request(gateway, "/page.css", Host=host.encode().decode("latin-1"))
    assert refused.status == 421
    assert refused.headers["content-security-policy"] == HEADERS["Content-Security-Policy"]
    assert gateway.pages.counts["host"] == 1
    assert len(gateway.logged) == 1 and "request for an unknown host name from this machine" in gateway.logged[0]


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost:9", "[::1]:8080", "192.168.1.5:8080", "CUP.example.org"])
def test_numeric_addresses_own_names_and_allowed_origins_are_names_of_the_server(host: str) -> None:
    assert Origins(["https://cup.example.org"]).knows(host)


FOREIGN = [
    "http://evil.example",
    "http://127.0.0.1.evil.example",
    "http://127.0.0.1@evil.example",
    "https://127.0.0.1",
    "null",
    "file://",
    "",
    "http://",
    "javascript:0",
    "http://[::1",
    "chrome-extension://abc",
]


def test_no_page_of_another_site_gets_a_socket(gateway: Gateway) -> None:
    for origin in FOREIGN:
        with pytest.raises(InvalidStatus) as refused:
            Visitor(gateway.origin, claims=origin)
        assert refused.value.response.status_code == 403
    assert gateway.pages.counts["foreign"] == len(FOREIGN) and len(gateway.pages) == 0


def test_a_page_that_has_the_servers_name_by_rebinding_gets_no_socket(gateway: Gateway) -> None:
    client = RawClient(gateway.port)
    assert b"403" in client.upgrade(f"http://evil.example:{gateway.port}")
    client.close()


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT"])
@pytest.mark.parametrize("path", ["/", "/ws", "/main.js", "/result/statistics.html"])
def test_no_form_and_no_method_of_another_site_changes_anything(gateway: Gateway, method: str, path: str) -> None:
    response = request(gateway, path, method, Origin="http://evil.example", Content_Type="text/plain")
    assert response.status in (400, 404, 405)
    assert "access-control-allow-origin" not in response.headers


def test_every_response_forbids_frames_script_from_elsewhere_and_to_send_its_address_on(
    gateway_of: Callable[..., Gateway], tmp_path: Path
) -> None:
    (tmp_path / "statistics.html").write_text("<script>1</script>")
    gateway = gateway_of(result=tmp_path)
    for path in ("/", "/main.js", "/missing", "/result/statistics.html", "/shared/pitch.js"):
        response = request(gateway, path)
        policy = response.headers["content-security-policy"]
        assert "frame-ancestors 'none'" in policy and "default-src 'none'" in policy and "form-action 'none'" in policy
        assert "base-uri 'none'" in policy and "*" not in policy
        assert response.headers["referrer-policy"] == "no-referrer"
        assert response.headers["x-content-type-options"] == "nosniff"
        assert response.headers["cache-control"] == "no-cache"
        assert "server" not in response.headers and "set-cookie" not in response.headers
        assert ("sandbox allow-scripts" in policy) == path.startswith("/result/")
        assert ("unsafe-inline" in policy) == path.startswith("/result/")


PATHS = [
    "/../tokens.json",
    "/..%2f..%2ftokens.json",
    "/%2e%2e/%2e%2e/tokens.json",
    "/%252e%252e/tokens.json",
    "/....//tokens.json",
    "//etc/passwd",
    "/%2fetc/passwd",
    "/result/../tokens.json",
    "/result/..%2ftokens.json",
    "/result/link.json",
    "/result/.hidden%00.html",
    "/shared/../../access/tokens.py",
    "/main.js%00.css",
    "/..%5c..%5ctokens.json",
    "/result/" + "a" * 5000,
    "/" + "../" * 1000 + "etc/passwd",
    "/?" + "a=b&" * 3000,
]


def test_no_path_leads_out_of_the_folders_that_are_served(gateway_of: Callable[..., Gateway], tmp_path: Path) -> None:
    result = tmp_path / "served"
    result.mkdir()
    secret = tmp_path / "tokens.json"
    secret.touch(0o600)
    secret.write_text('{"referee": "the-referee", "cyan": "cyans-coach", "magenta": "magentas-coach"}')
    (result / "link.json").symlink_to(secret)
    gateway = gateway_of(result=result)
    for path in PATHS:
        connection = http.client.HTTPConnection("127.0.0.1", gateway.port, timeout=SOON)
        connection.putrequest("GET", path)
        connection.endheaders()
        response = connection.getresponse()
        body = response.read()
        connection.close()
        assert b"the-referee" not in body and b"root:" not in body, path
        assert response.status == (200 if path.startswith("/?") else 404), (path, response.status)


def test_a_request_for_very_many_ranges_of_a_file_costs_no_more_than_the_file(gateway: Gateway) -> None:
    ranges = "bytes=" + ",".join(f"{number}-{number + 1}" for number in range(1500))
    assert request(gateway, "/page.css", Range=ranges).status in (200, 400, 416)


def test_the_token_of_an_address_reaches_neither_the_server_nor_another_site(gateway: Gateway) -> None:
    """It follows the #, is taken out of the address, and no page tells where it was opened."""
    script = (Path(__file__).parents[2] / "coach_gateway/web/page/token.js").read_text()
    assert "location.hash" in script and "history.replaceState" in script
    assert "localStorage" not in script and "cookie" not in script
    assert request(gateway, "/").headers["referrer-policy"] == "no-referrer"
