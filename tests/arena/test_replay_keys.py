"""The keys of a replay, its words on the screen, and what `touchline player` asks for."""

import io

import pytest

from arena.commands.player import request_of
from arena.replay_keys import KEYS, asks, legend
from arena.replay_screen import screen_on, words
from recordings.replay.moments import Moment
from schemas.clock import SteppedClock
from schemas.errors import TouchlineError
from schemas.replay import ReplayDeed, ReplayReply, ReplayRequest

MOMENTS = [Moment(1.0, "kick_off"), Moment(4.0, "goal"), Moment(9.0, "goal")]
AT_5 = ReplayReply(accepted=True, time=5.0, start=0.0, end=20.0, rate=1.0)


def asked(key: str, **standing) -> ReplayRequest:
    (ask,) = asks(key)
    return ask(AT_5.model_copy(update=standing), MOMENTS)


@pytest.mark.parametrize(
    ("key", "standing", "request_"),
    [
        (" ", {}, ReplayRequest(deed=ReplayDeed.PAUSE)),
        (" ", {"paused": True}, ReplayRequest(deed=ReplayDeed.PLAY)),
        (".", {}, ReplayRequest(deed=ReplayDeed.STEP)),
        ("\x1b[C", {}, ReplayRequest(deed=ReplayDeed.SEEK, by=5.0)),
        ("\x1b[D", {}, ReplayRequest(deed=ReplayDeed.SEEK, by=-5.0)),
        ("\x1b[A", {}, ReplayRequest(deed=ReplayDeed.RATE, rate=2.0)),
        ("\x1b[A", {"rate": 64.0}, ReplayRequest(deed=ReplayDeed.RATE)),
        ("\x1b[A", {"rate": None}, ReplayRequest(deed=ReplayDeed.RATE)),
        ("\x1b[B", {}, ReplayRequest(deed=ReplayDeed.RATE, rate=0.5)),
        ("\x1b[B", {"rate": None}, ReplayRequest(deed=ReplayDeed.RATE, rate=64.0)),
        ("l", {}, ReplayRequest(deed=ReplayDeed.LOOP)),
        ("q", {}, ReplayRequest(deed=ReplayDeed.LEAVE)),
    ],
)
def test_a_key_asks_for_what_it_says(key, standing, request_):
    assert asked(key, **standing) == request_


@pytest.mark.parametrize(
    ("key", "time", "to"),
    [
        ("n", 5.0, 9.0),
        ("n", 9.0, 20.0),
        ("b", 5.5, 4.0),
        ("b", 4.5, 1.0),
        ("b", 0.5, 0.0),
        ("0", 5.0, 0.0),
        ("e", 5.0, 20.0),
    ],
)
def test_keys_go_from_event_to_event(key, time, to):
    assert float(asked(key, time=time).to) == to


def test_other_keys_mean_nothing_and_all_keys_are_listed():
    assert asks("xyz\x1b[Z\t") == []
    assert all(name in legend() for name, _, _ in KEYS.values())


def test_how_it_stands_is_one_line():
    assert (
        words(AT_5.model_copy(update={"time": 75.24, "paused": True, "end": 120.0})) == "1:15.2 of 2:00.0  ×1  paused"
    )
    assert words(AT_5.model_copy(update={"rate": None, "loop": True})) == "0:05.0 of 0:20.0  as fast as possible  loop"


def test_a_pipe_gets_a_line_now_and_then():
    clock, stream = SteppedClock(), io.StringIO()
    with screen_on(stream, clock) as show:
        for _ in range(110):
            show(AT_5)
            clock.sleep_until(clock.now() + 0.1)
    assert stream.getvalue().count("\n") == 3


@pytest.mark.parametrize(
    ("deed", "value", "request_"),
    [
        (ReplayDeed.PAUSE, None, ReplayRequest(deed=ReplayDeed.PAUSE)),
        (ReplayDeed.SEEK, "goal:1-5", ReplayRequest(deed=ReplayDeed.SEEK, to="goal:1-5")),
        (ReplayDeed.SEEK, "-5", ReplayRequest(deed=ReplayDeed.SEEK, by=-5.0)),
        (ReplayDeed.RATE, "fast", ReplayRequest(deed=ReplayDeed.RATE)),
        (ReplayDeed.RATE, "2", ReplayRequest(deed=ReplayDeed.RATE, rate=2.0)),
        (ReplayDeed.STEP, "10", ReplayRequest(deed=ReplayDeed.STEP, ticks=10)),
    ],
)
def test_a_deed_and_its_value_are_a_request(deed, value, request_):
    assert request_of(deed, value) == request_


@pytest.mark.parametrize(
    ("deed", "value"),
    [
        (ReplayDeed.SEEK, None),
        (ReplayDeed.RATE, "0"),
        (ReplayDeed.STEP, "x"),
        (ReplayDeed.PAUSE, "5"),
        (ReplayDeed.SEEK, "+x"),
    ],
)
def test_a_value_that_is_wrong_is_said(deed, value):
    with pytest.raises(TouchlineError, match=deed.value):
        request_of(deed, value)
