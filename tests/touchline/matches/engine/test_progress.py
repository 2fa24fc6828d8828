"""What is shown while many matches are played."""

import json
import sys
from datetime import datetime
from io import StringIO

import pytest

from support.stepped_clock import SteppedClock
from touchline.matches.engine.progress import progress_of
from touchline.matches.engine.run_counts import RunCounts


class Terminal(StringIO):
    """Takes the place of a terminal."""

    def isatty(self) -> bool:
        return True


def counts(at_once: int = 2) -> tuple[RunCounts, SteppedClock]:
    clock = SteppedClock()
    clock.sleep_until(100.0)
    return RunCounts(clock, due=4, at_once=at_once), clock


def test_the_end_is_estimated_from_the_matches_that_have_ended_in_this_run() -> None:
    run, clock = counts()
    run.plan(10, 4, 0)
    assert run.remaining is None
    clock.sleep_until(106.0)
    run.add(failed=False)
    assert run.remaining == 18.0
    assert run.text.endswith(f"ends {datetime.fromtimestamp(clock.unix_ns() / 1e9 + 18.0):%H:%M}")
    assert (run.done, run.total) == (11, 14)


def test_running_and_failed_matches_are_counted_until_none_is_due() -> None:
    run, _ = counts(at_once=3)
    assert run.text == "3 running"
    for failed in (True, False, False):
        run.add(failed=failed)
    assert run.text.startswith("1 running, 1 failed, ends ")
    run.add(failed=False)
    assert (run.running, run.text) == (0, "1 failed")


def test_an_end_on_another_day_has_its_date() -> None:
    run, clock = counts()
    clock.sleep_until(86_400.0)
    run.add(failed=False)
    assert len(run.text.rpartition("ends ")[2].split()) == 3


def test_without_a_terminal_each_match_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_of("cup") as progress:
        progress.planned(0, 3)
        progress.ended("one: 1 : 0")
        progress.ended("two: failed: no brain", failed=True)
        progress.planned(2, 3, 1)
        progress.ended("three: 0 : 0")
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].startswith("1/3 one: 1 : 0   (1 running, ends ")
    assert lines[1].startswith("2/3 two: failed: no brain   (1 running, 1 failed, ends ")
    assert lines[2].startswith("3/5 three")


def test_as_json_each_match_is_one_object(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_of("cup", json=True) as progress:
        progress.planned(0, 2)
        progress.ended("one: 1 : 0")
        progress.ended("two: failed", failed=True)
    captured = capsys.readouterr()
    first, second = map(json.loads, captured.err.splitlines())
    assert captured.out == ""
    assert first.pop("remaining") >= 0.0
    assert first == {"done": 1, "total": 2, "running": 1, "failed": 0, "match": "one: 1 : 0", "match_failed": False}
    assert second["match_failed"] and second["failed"] == 1 and second["running"] == 0


def test_on_a_terminal_a_match_that_fails_stays_above_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("COLUMNS", "120")
    with progress_of("[b]cup[/b]") as progress:
        progress.planned(0, 2)
        progress.ended("[i]one: failed: no brain", failed=True)
        progress.ended("two: 1 : 0")
    text = terminal.getvalue()
    assert "[b]cup[/b]" in text and "2/2" in text and "two: 1 : 0" in text
    assert text.count("[i]one: failed: no brain") == 1
