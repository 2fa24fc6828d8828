"""The progress of a replay on the screen."""

from schemas.messages.replay import ReplayReply
from touchline.launch.terminal.replay_progress import bar_text, status_text

AT_5 = ReplayReply(accepted=True, time=5.0, start=0.0, end=20.0, rate=1.0)


def test_how_it_stands_is_one_line():
    assert status_text(AT_5.replace(time=75.24, paused=True, end=120.0)) == "1:15.2 of 2:00.0  ×1  paused"
    assert status_text(AT_5.replace(rate=None, loop=True)) == "0:05.0 of 0:20.0  as fast as possible  loop"


def test_a_terminal_has_a_bar_before_it():
    assert bar_text(AT_5) == f"{'━' * 10}{'╌' * 30}  {status_text(AT_5)}"
