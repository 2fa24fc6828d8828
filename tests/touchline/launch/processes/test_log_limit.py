"""A log is cut while its process writes: it keeps its beginning and its newest lines."""

import os
from pathlib import Path

import pytest

from touchline.launch.processes.log_limit import LogLimit

NOTICE = "touchline: this log is limited to 0.001 MB; later lines are left out here, except the newest"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "cyan1.log"


def write(log: Path, first: int, count: int) -> None:
    """Append numbered lines of ten bytes, as a process does that has opened the log to append."""
    with log.open("ab") as file:
        file.write(b"".join(b"line %04d\n" % number for number in range(first, first + count)))


def test_a_log_within_the_limit_and_one_that_is_not_there_are_left_alone(log: Path) -> None:
    limit = LogLimit(1000, 500)
    assert limit.check(log) == ""
    write(log, 0, 100)
    assert limit.check(log) == ""
    assert log.stat().st_size == 1000


def test_a_log_beyond_the_limit_keeps_its_beginning_and_has_a_line_that_says_so(log: Path) -> None:
    write(log, 0, 300)
    sentence = LogLimit(1005, 500).check(log)
    assert sentence == (
        f"cyan1 has written more than 0.001005 MB into {log}, which keeps these and the newest lines; print less"
    )
    lines = log.read_text().splitlines()
    assert lines[:-1] == [f"line {number:04d}" for number in range(100)]
    assert lines[-1].startswith("touchline: this log is limited to 0.001005 MB")


def test_the_newest_lines_follow_and_the_log_does_not_grow(log: Path) -> None:
    limit = LogLimit(1000, 500)
    write(log, 0, 120)
    assert limit.check(log)
    for first in range(1000, 9000, 40):
        write(log, first, 40)
        assert limit.check(log) == ""
        assert log.stat().st_size <= 1000 + len(NOTICE) + 1 + 500
    write(log, 9000, 3)
    assert limit.check(log) == ""
    lines = log.read_text().splitlines()
    assert lines[:100] == [f"line {number:04d}" for number in range(100)]
    assert lines[100] == NOTICE
    assert lines[-3:] == ["line 9000", "line 9001", "line 9002"]


def test_a_log_without_line_ends_is_cut_at_the_limit(log: Path) -> None:
    log.write_bytes(b"x" * 20_000)
    assert LogLimit(10_000, 500).check(log)
    assert log.read_bytes().startswith(b"x" * 10_000 + b"touchline: ")


def test_each_log_has_a_limit_of_its_own(log: Path, tmp_path: Path) -> None:
    limit = LogLimit(1000, 500)
    other = tmp_path / "cyan2.log"
    for one in (log, other):
        write(one, 0, 120)
        assert limit.check(one).startswith(one.stem)
        assert limit.check(one) == ""


def test_the_line_stays_where_the_process_writes_in_the_moment_of_the_cut(
    log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As seen once with a brain that prints 50 kB a tick: the line was gone after the next cut."""
    truncate = os.truncate

    def truncate_and_go_on(path: Path, length: int) -> None:
        truncate(path, length)
        write(path, 900, 30)

    limit = LogLimit(1000, 500)
    write(log, 0, 300)
    monkeypatch.setattr(os, "truncate", truncate_and_go_on)
    limit.check(log)
    write(log, 300, 100)
    limit.check(log)
    assert log.read_text().splitlines().count(NOTICE) == 1
