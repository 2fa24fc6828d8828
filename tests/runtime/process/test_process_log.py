"""The log of a process: text as people read it, or one JSON object a line."""

import io
import json
import logging
from collections.abc import Iterator

import pytest

from runtime.process.log_format import LogFormat
from runtime.process.process_log import Level, configure_log, log_line, message_of
from runtime.process.settings_file import exit_status
from schemas.errors import TouchlineError


@pytest.fixture(autouse=True)
def fresh(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No format is in force, before and after; the handlers of the test runner come back."""
    monkeypatch.delenv("TOUCHLINE_LOG", raising=False)
    configure_log("touchline", LogFormat.TEXT)
    handlers, level = logging.root.handlers[:], logging.root.level
    yield
    configure_log("touchline", LogFormat.TEXT)
    logging.root.handlers[:] = handlers
    logging.root.setLevel(level)


def test_text_is_the_line_and_nothing_else(capsys: pytest.CaptureFixture[str]) -> None:
    configure_log("agent", robot="cyan1")
    log_line("the host has been gone for 10 s; leaving", Level.WARNING, seconds=10)
    assert capsys.readouterr().err == "the host has been gone for 10 s; leaving\n"


def test_a_line_on_a_full_disk_is_lost_and_ends_nothing() -> None:
    with io.TextIOWrapper(io.FileIO("/dev/full", "w"), write_through=True) as full:
        log_line("sense takes longer than its deadline", stream=full)


def test_json_is_one_object_a_line_with_time_process_level_robot_message_and_fields(
    capsys: pytest.CaptureFixture[str],
) -> None:
    configure_log("agent", LogFormat.JSON, robot="cyan1")
    log_line("act failed\n  at line 3\n", Level.ERROR, tick=57)
    (line,) = capsys.readouterr().err.splitlines()
    content = json.loads(line)
    assert content.pop("time").endswith("Z")
    assert content.pop("pid") > 0
    assert content == {
        "process": "agent",
        "level": "error",
        "robot": "cyan1",
        "message": "act failed\n  at line 3\n",
        "tick": 57,
    }


def test_records_of_the_standard_library_are_objects_too(capsys: pytest.CaptureFixture[str]) -> None:
    logging.root.handlers.clear()
    configure_log("host", LogFormat.JSON)
    logging.getLogger("sim_host").warning("%s joined", "cyan1")
    content = json.loads(capsys.readouterr().err)
    assert (content["process"], content["level"], content["message"]) == ("host", "warning", "cyan1 joined")
    assert (content["logger"], content["robot"]) == ("sim_host", None)


def test_a_traceback_stays_in_the_line_of_its_record(capsys: pytest.CaptureFixture[str]) -> None:
    logging.root.handlers.clear()
    configure_log("gateway", LogFormat.JSON)
    try:
        raise ValueError("no such page")
    except ValueError:
        logging.getLogger("web").exception("request failed")
    (line,) = capsys.readouterr().err.splitlines()
    assert "ValueError: no such page" in json.loads(line)["message"]


def test_the_environment_has_the_format_of_processes_that_are_given_none(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("TOUCHLINE_LOG", "json")
    configure_log("recorder")
    log_line("waiting")
    assert json.loads(capsys.readouterr().err)["message"] == "waiting"
    configure_log("recorder", LogFormat.TEXT)
    log_line("waiting")
    assert capsys.readouterr().err == "waiting\n"


def test_an_unknown_format_of_the_environment_is_refused_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TOUCHLINE_LOG", "yaml")
    with pytest.raises(TouchlineError, match="TOUCHLINE_LOG is 'yaml'; set it to text or json"):
        configure_log("host")


def test_a_process_that_cannot_begin_writes_its_reason_in_the_format(capsys: pytest.CaptureFixture[str]) -> None:
    def run() -> int:
        raise TouchlineError("no host answers")

    assert exit_status(run) == 2
    assert capsys.readouterr().err == "touchline: no host answers\n"
    configure_log("agent", LogFormat.JSON, "cyan1")
    assert exit_status(run) == 2
    content = json.loads(capsys.readouterr().err)
    assert (content["level"], content["message"]) == ("error", "no host answers")


def test_the_message_of_a_line_is_the_same_in_both_formats() -> None:
    stream = io.StringIO()
    configure_log("host", LogFormat.JSON)
    log_line("match over", stream=stream)
    assert message_of(stream.getvalue().rstrip()) == message_of("match over") == "match over"
    assert message_of(stream.getvalue()[:40]) == stream.getvalue()[:40], "a line that was cut off"
