"""Which origins may connect: no foreign DNS name can point a browser to an allowed one."""

import pytest

from coach_gateway.access.origins import Origins
from schemas.errors import TouchlineError


@pytest.mark.parametrize(
    ("origin", "host"),
    [
        ("http://127.0.0.1:8080", "127.0.0.1:8080"),
        ("http://localhost:8080", "localhost:8080"),
        ("http://[::1]:8080", "[::1]:8080"),
        ("http://192.168.1.5:8080", "192.168.1.5:8080"),
        ("http://field:8080", "field:8080"),
        ("http://FIELD:8080", "field:8080"),
        ("https://cup.example.org", "127.0.0.1:8080"),
    ],
)
def test_our_own_page_and_an_allowed_one_come_in(origin: str, host: str) -> None:
    assert Origins(["https://Cup.Example.org"], ["localhost", "field"]).allows(origin, host)


@pytest.mark.parametrize(
    ("origin", "host"),
    [
        (None, "127.0.0.1:8080"),
        ("null", "127.0.0.1:8080"),
        ("", ""),
        ("http://127.0.0.1:8080", None),
        ("http://127.0.0.1:8081", "127.0.0.1:8080"),
        ("https://127.0.0.1:8080", "127.0.0.1:8080"),
        ("http://evil.example", "127.0.0.1:8080"),
        ("http://evil.example:8080", "evil.example:8080"),  # a name of theirs that leads to our address
        ("http://127.0.0.1.evil.example:8080", "127.0.0.1.evil.example:8080"),
        ("https://cup.example.org.evil.example", "127.0.0.1:8080"),
        ("file://", "127.0.0.1:8080"),
        ("http://", "127.0.0.1:8080"),
        ("http://127.0.0.1@evil.example", "127.0.0.1:8080"),
        ("javascript:0", "127.0.0.1:8080"),
        ("chrome-extension://abc", "127.0.0.1:8080"),
        ("http://[::1", "[::1"),
    ],
)
def test_a_foreign_origin_is_not_allowed(origin: str | None, host: str | None) -> None:
    assert not Origins(["https://cup.example.org"], ["localhost"]).allows(origin, host)


@pytest.mark.parametrize(
    "origin", ["cup.example.org", "https://cup.example.org/page", "ftp://cup.example.org", "*", "", "https://[::1"]
)
def test_an_origin_that_is_none_is_refused_with_how_to_write_it(origin: str) -> None:
    with pytest.raises(TouchlineError, match="write it as https://"):
        Origins([origin])


@pytest.mark.parametrize(
    "host", ["127.0.0.1", "localhost:9", "[::1]:8080", "192.168.1.5:8080", "CUP.example.org", None]
)
def test_numeric_addresses_own_names_and_allowed_origins_are_names_of_the_server(host: str | None) -> None:
    assert Origins(["https://cup.example.org"]).knows(host)


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "localhost.evil.example", "", "[", "a@b", "☃"]
)
def test_a_name_that_a_foreign_dns_entry_points_here_is_none_of_the_server(host: str) -> None:
    assert not Origins(["https://cup.example.org"]).knows(host)
