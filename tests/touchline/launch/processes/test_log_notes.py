"""Notes in the logs of robots, for the user at the terminal."""

import io

import pytest

from runtime.process.process_log import NOTE
from support.stepped_clock import SteppedClock
from touchline.launch.processes.log_notes import LogNotes, LogWatch
from touchline.launch.processes.supervisor import Notice
from touchline.launch.terminal.screen import Screen

BUG = "(my_team.py, line 7): KeyError: 'plan'"


def test_each_note_is_found_once_when_its_line_is_whole(tmp_path):
    log, notes = tmp_path / "cyan1.log", LogNotes()
    assert notes.update(log) == []
    log.write_text(f"printed by the brain\n{NOTE}one: first\x1b[2J\n{NOTE}two: sec")
    assert notes.update(log) == ["one: first�[2J"]
    with log.open("a") as file:
        file.write("ond\nmore\n")
    assert notes.update(log) == ["two: second"]
    assert notes.update(log) == []


def test_of_notes_with_the_same_subject_the_first_is_shown(tmp_path):
    notes, found = LogNotes(), []
    for robot in ("cyan1", "cyan2"):
        log = tmp_path / f"{robot}.log"
        log.write_text(f"{NOTE}breakpoint() at my.py, line 7: {robot}\n")
        found += notes.update(log)
    assert found == ["breakpoint() at my.py, line 7: cyan1"]


def test_a_note_in_a_log_of_json_is_found(tmp_path):
    log = tmp_path / "cyan1.log"
    log.write_text('{"time": "now", "message": "note: one: first"}\n{"time": "now", "message": "another"}\n')
    assert LogNotes().update(log) == ["one: first"]


def test_a_log_that_was_cut_is_read_on(tmp_path):
    log, notes = tmp_path / "cyan1.log", LogNotes()
    log.write_text(f"{'long ' * 100}\n")
    assert notes.update(log) == []
    log.write_text("cut\n")
    assert notes.update(log) == []
    with log.open("a") as file:
        file.write(f"{NOTE}one: first\n")
    assert notes.update(log) == ["one: first"]


@pytest.fixture
def shown() -> io.StringIO:
    return io.StringIO()


@pytest.fixture
def watch(shown: io.StringIO) -> LogWatch:
    return LogWatch(Screen(shown, SteppedClock()))


def test_one_fault_of_five_robots_is_a_line_and_at_the_end_a_count(watch: LogWatch, shown: io.StringIO) -> None:
    for number in (1, 2, 3, 4, 5, 1, 2):
        log = ("Traceback (most recent call last):", "    self.plan", f"act raised at tick {40 + number} {BUG}")
        watch.show(Notice(f"cyan{number}", f"cyan{number} ended with status 1", log))
    watch.count()
    assert shown.getvalue().splitlines() == [
        f"cyan1 ended with status 1: act raised at tick 41 {BUG}; cyan1.log has the traceback",
        f"7 times (cyan1 2, cyan2 2, cyan3 1, cyan4 1, cyan5 1): act raised {BUG}",
    ]


def test_two_faults_are_two_lines_and_a_limit_is_named_with_its_remedy(watch: LogWatch, shown: io.StringIO) -> None:
    limit = "limit reached: more than 1 GB; raise [limits] memory"
    watch.show(Notice("cyan1", "cyan1 ended with status 1", ("act failed at tick 3: play returned None",)))
    watch.show(Notice("cyan2", "cyan2 ended with status 1", (f"act raised at tick 9 {BUG}", limit)))
    watch.count()
    assert shown.getvalue().splitlines() == [
        "cyan1 ended with status 1: act failed at tick 3: play returned None",
        f"cyan2 ended with status 1: act raised at tick 9 {BUG}; {limit}",
    ]


def test_what_is_no_fault_of_a_brain_is_shown_with_its_log_each_time(watch: LogWatch, shown: io.StringIO) -> None:
    for _ in range(2):
        watch.show(Notice("cyan1", "cyan1 was ended by SIGKILL", ("printed",)))
    watch.count()
    assert shown.getvalue().splitlines() == ["cyan1 was ended by SIGKILL", "  cyan1: printed"] * 2


def test_the_first_robot_that_leaves_the_match_with_a_fault_is_named(watch: LogWatch, shown: io.StringIO) -> None:
    for name, then in (("cyan1", "started again"), ("cyan1", "not started again"), ("cyan2", "not started again")):
        watch.show(Notice(name, f"{name} failed; {then}", (f"act raised at tick 9 {BUG}",)))
    assert shown.getvalue().splitlines() == [
        f"cyan1 failed; started again: act raised at tick 9 {BUG}",
        "cyan1 failed; not started again",
    ]
