"""Attacks on the page of `touchline replay --web`: what is recorded stays as it is, and viewers command nothing."""

from collections.abc import Callable

import pytest

from schemas.messages.replay import ReplayOperation
from support.fake_host import FakeHost
from support.messages import make_event
from support.page_gateway import Gateway
from support.visitor import Visitor

CHANGES = [
    ("order", {"side": "cyan", "order": {"mode": "hold"}}),
    ("drive", {"robot": "cyan1", "manual": {"drive": {"vx": 1.0}}}),
]
"""What a person may do in a match, and nobody in a replay."""
SEEK = {"request": {"operation": "seek", "to": "1.5"}}
HOSTILE = [
    {"operation": "seek", "time": 5.0},
    {"operation": "seek", "by": float("nan")},
    {"operation": "seek", "by": "1e999x"},
    {"operation": "seek", "to": [1]},
    {"operation": "rate", "rate": -1},
    {"operation": "rate", "rate": 0},
    {"operation": "step", "ticks": -5},
    {"operation": "load", "path": "/etc/passwd"},
    {"operation": "seek", "to": "1.5", "path": "/etc/passwd"},
    {"operation": {"$ne": ""}},
    None,
]


@pytest.fixture
def replay(host_of: Callable[..., FakeHost]) -> FakeHost:
    """A replay of two events."""
    return host_of(recorded=[make_event(1, "first"), make_event(900, "last")])


@pytest.fixture
def gateway(gateway_of: Callable[..., Gateway], replay: FakeHost) -> Gateway:
    return gateway_of()


def controls_of(replay: FakeHost) -> list[ReplayOperation]:
    """What the replay was asked to do, beside telling its status and its events."""
    reading = (ReplayOperation.STATUS, ReplayOperation.EVENTS, ReplayOperation.STEP)
    return [one.operation for one in replay.asked if getattr(one, "operation", None) not in (*reading, None)]


def test_viewers_and_coaches_neither_seek_nor_pause_a_replay_that_others_watch(
    gateway: Gateway, replay: FakeHost
) -> None:
    page = Visitor(gateway.origin)
    page.hear_what_is_played()
    for role in ("spectator", "cyan"):
        if role == "cyan":
            page.enter(role)
        for operation in ({"request": {"operation": "pause"}}, SEEK):
            reply = page.ask("replay", **operation)
            assert not reply["accepted"] and "needs the referee's token" in reply["reason"]
    page.close()
    assert controls_of(replay) == []


@pytest.mark.parametrize("role", ["referee", "cyan"])
def test_nobody_changes_what_is_recorded(gateway: Gateway, replay: FakeHost, role: str) -> None:
    page = Visitor(gateway.origin)
    page.hear_what_is_played()
    page.enter(role)
    for deed, content in CHANGES:
        reply = page.ask(deed, **content)
        assert (reply["accepted"], reply["reason"]) == (False, "this is a replay: what is recorded cannot be changed")
    page.close()
    assert replay.given_orders == [] and replay.hands.receive() is None


def test_controls_that_are_none_are_refused_in_one_line_and_the_replay_goes_on(
    gateway: Gateway, replay: FakeHost
) -> None:
    page = Visitor(gateway.origin)
    page.hear_what_is_played()
    page.enter("referee")
    for request in HOSTILE:
        reply = page.ask("replay", request=request)
        assert not reply["accepted"] and 0 < len(reply["reason"]) < 1000 and "\n" not in reply["reason"], request
    assert controls_of(replay) == []
    assert page.ask("replay", **SEEK)["accepted"]
    assert controls_of(replay) == [ReplayOperation.SEEK]
    page.close()
