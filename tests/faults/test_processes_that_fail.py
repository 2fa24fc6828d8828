"""Processes of a match that are killed, suspended, or have a wrong clock."""

import pytest

from support.faulty_match import PATIENCE_S, Match

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

SECOND = 50
"""Ticks of a second."""
WRONG_CLOCK = """
import time

_time_ns = time.time_ns
time.time_ns = lambda: _time_ns() + 3_600_000_000_000
time.time = lambda: time.time_ns() * 1e-9
"""


def test_suspended_agents_play_again(match: Match) -> None:
    stopped = ("cyan2", "cyan3")
    _, last = match.after_fault(lambda: match.field.suspend(*stopped), 3 * SECOND, lambda: match.field.resume(*stopped))
    assert match.until_playing(*stopped, since=last) - last <= 3 * SECOND


def test_a_robot_whose_clock_is_an_hour_off_plays(match: Match) -> None:
    folder = match.field.folder / "wrong"
    folder.mkdir()
    (folder / "sitecustomize.py").write_text(WRONG_CLOCK)
    match.field.kill("cyan4")
    match.log.until(lambda log: not log.robot("cyan4").alive, "the end of cyan4")
    program = match.field.start_agent("cyan4", "cyan", PATIENCE_S, PYTHONPATH=f"{folder}:{match.field.python_path}")
    tick = match.until_playing("cyan4", since=match.log.tick)
    match.log.until_tick(tick + 2 * SECOND)
    health = match.log.robot("cyan4")
    assert not health.invalid
    assert health.latency_ms is not None and health.latency_ms < 60_000
    assert program.popen.poll() is None
