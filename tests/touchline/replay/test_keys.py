"""The keys of a replay, its words on the screen, and what `touchline player` asks for."""

import io

import pytest

from recordings.replay.seek_targets import SeekTarget
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.process.clock import SteppedClock
from touchline.commands.player import request_of
from touchline.replay.keys import KEYS, key_requests, legend
from touchline.replay.progress import progress_on, status_text

MOMENTS = [SeekTarget(1.0, "kick_off"), SeekTarget(4.0, "goal"), SeekTarget(9.0, "goal")]
AT_5 = ReplayReply(accepted=True, time=5.0, start=0.0, end=20.0, rate=1.0)


def asked(key: str, **standing) -> ReplayRequest:
    (ask,) = key_requests(key)
    return ask(AT_5.model_copy(update=standing), MOMENTS)


@pytest.mark.parametrize(
    ("key", "standing", "request_"),
    [
        (" ", {}, ReplayRequest(operation=ReplayOperation.PAUSE)),
        (" ", {"paused": True}, ReplayRequest(operation=ReplayOperation.PLAY)),
        (".", {}, ReplayRequest(operation=ReplayOperation.STEP)),
        ("\x1b[C", {}, ReplayRequest(operation=ReplayOperation.SEEK, by=5.0)),
        ("\x1b[D", {}, ReplayRequest(operation=ReplayOperation.SEEK, by=-5.0)),
        ("\x1b[A", {}, ReplayRequest(operation=ReplayOperation.RATE, rate=2.0)),
        ("\x1b[A", {"rate": 64.0}, ReplayRequest(operation=ReplayOperation.RATE)),
        ("\x1b[A", {"rate": None}, ReplayRequest(operation=ReplayOperation.RATE)),
        ("\x1b[B", {}, ReplayRequest(operation=ReplayOperation.RATE, rate=0.5)),
        ("\x1b[B", {"rate": None}, ReplayRequest(operation=ReplayOperation.RATE, rate=64.0)),
        ("l", {}, ReplayRequest(operation=ReplayOperation.LOOP)),
        ("q", {}, ReplayRequest(operation=ReplayOperation.LEAVE)),
    ],
)
def test_a_key_makes_the_described_request(key, standing, request_):
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
    assert key_requests("xyz\x1b[Z\t") == []
    assert all(name in legend() for name, _, _ in KEYS.values())


def test_how_it_stands_is_one_line():
    assert (
        status_text(AT_5.model_copy(update={"time": 75.24, "paused": True, "end": 120.0}))
        == "1:15.2 of 2:00.0  ×1  paused"
    )
    assert (
        status_text(AT_5.model_copy(update={"rate": None, "loop": True}))
        == "0:05.0 of 0:20.0  as fast as possible  loop"
    )


def test_a_pipe_gets_a_line_now_and_then():
    clock, stream = SteppedClock(), io.StringIO()
    with progress_on(stream, clock) as show:
        for _ in range(110):
            show(AT_5)
            clock.sleep_until(clock.now() + 0.1)
    assert stream.getvalue().count("\n") == 3


@pytest.mark.parametrize(
    ("operation", "value", "request_"),
    [
        (ReplayOperation.PAUSE, None, ReplayRequest(operation=ReplayOperation.PAUSE)),
        (ReplayOperation.SEEK, "goal:1-5", ReplayRequest(operation=ReplayOperation.SEEK, to="goal:1-5")),
        (ReplayOperation.SEEK, "-5", ReplayRequest(operation=ReplayOperation.SEEK, by=-5.0)),
        (ReplayOperation.RATE, "fast", ReplayRequest(operation=ReplayOperation.RATE)),
        (ReplayOperation.RATE, "2", ReplayRequest(operation=ReplayOperation.RATE, rate=2.0)),
        (ReplayOperation.STEP, "10", ReplayRequest(operation=ReplayOperation.STEP, ticks=10)),
    ],
)
def test_a_deed_and_its_value_are_a_request(operation, value, request_):
    assert request_of(operation, value) == request_


@pytest.mark.parametrize(
    ("operation", "value"),
    [
        (ReplayOperation.SEEK, None),
        (ReplayOperation.RATE, "0"),
        (ReplayOperation.STEP, "x"),
        (ReplayOperation.PAUSE, "5"),
        (ReplayOperation.SEEK, "+x"),
    ],
)
def test_a_wrong_value_is_reported(operation, value):
    with pytest.raises(TouchlineError, match=operation.value):
        request_of(operation, value)
