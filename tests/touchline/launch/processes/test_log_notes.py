"""Notes in the logs of robots, for the user at the terminal."""

from runtime.process.process_log import NOTE
from touchline.launch.processes.log_notes import LogNotes


def test_each_note_is_found_once_when_its_line_is_whole(tmp_path):
    log, notes = tmp_path / "cyan1.log", LogNotes()
    assert notes.update(log) == []
    log.write_text(f"printed by the brain\n{NOTE}one: first\n{NOTE}two: sec")
    assert notes.update(log) == ["one: first"]
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
