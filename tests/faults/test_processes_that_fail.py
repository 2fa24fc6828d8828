"""Processes of a match that are killed, suspended, or have a wrong clock."""

import pytest

from support.faulty_match import CYAN, PATIENCE_S, Match

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

SECOND = 50
"""Ticks of a second."""
WRONG_CLOCK = """
import time

_time_ns = time.time_ns
time.time_ns = lambda: _time_ns() + 3_600_000_000_000
time.time = lambda: time.time_ns() * 1e-9
"""


@pytest.mark.parametrize("seconds", [3, pytest.param(8, marks=pytest.mark.long)])
def test_suspended_agents_play_again(match: Match, seconds: int) -> None:
    stopped = ("cyan2", "cyan3")
    _, last = match.after_fault(
        lambda: match.field.suspend(*stopped), seconds * SECOND, lambda: match.field.resume(*stopped)
    )
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


@pytest.mark.long
def test_a_match_goes_on_after_the_machine_was_suspended(match: Match) -> None:
    """All processes at once, for longer than the agents wait for a host.

    The observer is a new client: of those that were not suspended with the host, one of a hundred gets no data any more
    over its next link (zenoh 1.10.2), and has to be started again.
    """
    everything = ("host", *CYAN, "magenta1")
    match.log.update()
    before = match.log.tick
    match.field.suspend(*everything)
    match.pause(PATIENCE_S + 1.0)
    match.field.resume(*everything)
    match.listen_again()
    match.until_playing(*CYAN, "magenta1", since=before + SECOND)
