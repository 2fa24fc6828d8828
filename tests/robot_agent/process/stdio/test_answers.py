import json

import pytest

from robot_agent.process.stdio.answers import AnswerFault, Expected, judge
from robot_agent.process.stdio.lines import Line
from schemas.messages.command import Command, Drive

EXPECTED = Expected(awaited=7, given_up=(5,), answered=6)


def line_of(**fields: object) -> Line:
    return Line(json.dumps(fields).encode())


def test_a_command_for_the_awaited_sight_is_its_answer() -> None:
    verdict = judge(line_of(answers_tick=7, drive={"vx": 1.5}), EXPECTED)
    assert verdict.command == Command(answers_tick=7, drive=Drive(vx=1.5))
    assert (verdict.fault, verdict.ends_wait) == (None, True)


@pytest.mark.parametrize("blank", [b"", b"  \r"])
def test_an_empty_line_is_nothing(blank: bytes) -> None:
    assert judge(Line(blank), EXPECTED) == judge(Line(b""), EXPECTED)
    assert judge(Line(blank), EXPECTED).fault is None


@pytest.mark.parametrize(
    ("line", "fault", "words", "ends_wait"),
    [
        (Line(b"ball seen"), AnswerFault.STRAY, "'ball seen': no JSON object", False),
        (Line(b"[1, 2]"), AnswerFault.STRAY, "no JSON object", False),
        (Line(b"\xff\xfe"), AnswerFault.STRAY, "no JSON object", False),
        (Line(b"x" * 5000, is_cut=True), AnswerFault.STRAY, "no JSON object", False),
        (Line(b"{" + b"x" * 4095, is_cut=True), AnswerFault.INVALID, f"longer than {Command.max_bytes} bytes", True),
        (Line(b'{"answers_tick": 7, "drive": {"vx": NaN}}'), AnswerFault.INVALID, "drive.vx is nan", True),
        (Line(b'{"answers_tick": 7'), AnswerFault.INVALID, "is not JSON", True),
        (line_of(answers_tick=7, speed=1), AnswerFault.INVALID, "speed is not known", True),
        (line_of(answers_tick=6, speed=1), AnswerFault.INVALID, "speed is not known", False),
        (line_of(drive={}), AnswerFault.INVALID, "answers_tick is missing", True),
        (line_of(answers_tick=7, drive={"vx": 99}), AnswerFault.INVALID, "drive.vx is 99; m/s from -20 to 20", True),
        (line_of(answers_tick=7, version="9.0"), AnswerFault.INVALID, "9.0", True),
        (line_of(answers_tick=6), AnswerFault.SECOND, "a second answer to tick 6", False),
        (line_of(answers_tick=99), AnswerFault.OTHER_TICK, "answers_tick is 99, the sight is of tick 7", False),
        (line_of(answers_tick=5), AnswerFault.LATE, "an answer to tick 5 after newer sights", False),
    ],
)
def test_a_fault_is_named_with_the_beginning_of_its_line(
    line: Line, fault: AnswerFault, words: str, ends_wait: bool
) -> None:
    verdict = judge(line, EXPECTED)
    assert (verdict.fault, verdict.ends_wait) == (fault, ends_wait)
    assert words in verdict.reason
    beginning = line.content.decode("utf-8", "replace")[:20]
    assert verdict.reason.startswith(f"'{beginning}") or verdict.reason.startswith(repr(beginning)[:20])
    assert len(verdict.reason) < 400


def test_a_late_answer_is_published_all_the_same() -> None:
    assert judge(line_of(answers_tick=5), EXPECTED).command == Command(answers_tick=5)


def test_an_answer_before_any_sight_is_named() -> None:
    assert "no sight is awaited" in judge(line_of(answers_tick=0), Expected(None)).reason
