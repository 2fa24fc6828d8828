"""The result of a match on its page: sent when it is written, served until no page is open any more."""

import http.client
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from coach_gateway.web.pages import broadcaster
from coach_gateway.web.pages.match_result import STATISTICS, STATISTICS_ADDRESS, write_result
from coach_gateway.web.pages.protocol import ResultUpdate
from support.fake_host import FakeHost
from support.page_gateway import SOON, Gateway
from support.visitor import Visitor

KNOWN = ResultUpdate(replay="touchline replay match.mcap --web")
WHOLE = KNOWN.replace(figures=[("shots", "3", "1")], statistics=STATISTICS_ADDRESS)


@pytest.fixture(autouse=True)
def short_grace(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(broadcaster, "RELOAD_S", 0.3)
    monkeypatch.setattr(broadcaster, "STATUS_S", 0.01)


def test_the_result_stays_until_the_last_page_is_closed(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway], tmp_path: Path
) -> None:
    host, gateway = host_of(), gateway_of(result=tmp_path)
    pages = [Visitor(gateway.origin) for _ in range(2)]
    for page in pages:
        page.hear_what_is_played()
    host.close()
    write_result(tmp_path, KNOWN)
    assert [page.hear("result")["replay"] for page in pages] == [KNOWN.replay] * 2
    pages[0].close()
    threading.Event().wait(0.1)  # nothing is sent twice
    (tmp_path / STATISTICS).write_text("<title>statistics</title>")
    write_result(tmp_path, WHOLE)
    assert pages[1].hear("result")["figures"] == [["shots", "3", "1"]]
    files = http.client.HTTPConnection(gateway.origin.removeprefix("http://"), timeout=SOON)
    files.request("GET", f"/{STATISTICS_ADDRESS}")
    answer = files.getresponse()
    assert answer.read() == b"<title>statistics</title>"
    assert answer.headers["Content-Security-Policy"].startswith("sandbox allow-scripts; default-src 'none'")
    files.close()
    late = Visitor(gateway.origin)
    assert late.hear("result")["statistics"] == STATISTICS_ADDRESS
    assert gateway.runs
    for page in (pages[1], late):
        page.close()
    assert gateway.wait()


def test_a_server_without_a_page_ends_with_the_match(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway], tmp_path: Path
) -> None:
    host, gateway = host_of(), gateway_of(result=tmp_path)
    host.close()
    assert gateway.runs  # the recording may take a while
    write_result(tmp_path, KNOWN)
    assert gateway.wait()


def test_a_host_that_leaves_does_not_end_a_server_without_a_result(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    host, gateway = host_of(), gateway_of()
    page = Visitor(gateway.origin)
    page.hear_what_is_played()
    host.close()
    page.hear("host", there=False)
    page.close()
    threading.Event().wait(0.6)
    assert gateway.runs
