"""The progress of a replay on the screen."""

import io

from schemas.messages.replay import ReplayReply
from schemas.process.clock import SteppedClock
from touchline.replay.progress import progress_on, status_text

AT_5 = ReplayReply(accepted=True, time=5.0, start=0.0, end=20.0, rate=1.0)


def test_how_it_stands_is_one_line():
    assert status_text(AT_5.replace(time=75.24, paused=True, end=120.0)) == "1:15.2 of 2:00.0  ×1  paused"
    assert status_text(AT_5.replace(rate=None, loop=True)) == "0:05.0 of 0:20.0  as fast as possible  loop"


def test_a_pipe_gets_a_line_now_and_then():
    clock, stream = SteppedClock(), io.StringIO()
    with progress_on(stream, clock) as show:
        for _ in range(110):
            show(AT_5)
            clock.sleep_until(clock.now() + 0.1)
    assert stream.getvalue().count("\n") == 3
