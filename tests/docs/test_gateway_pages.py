"""The pages on the page, coach programs and the referee box: their tables and messages are complete and valid."""

import re
from pathlib import Path

import pytest

from coach_gateway.access.rights import RIGHTS
from coach_gateway.access.roles import TokenRole
from coach_gateway.soccer.refbox.forwarding import FORWARD
from coach_gateway.udp import protocol
from coach_gateway.udp.coach_record import TEST_MODES, MatchMode
from coach_gateway.web.pages.protocol import read_request
from schemas.messages.coach import REQUIRED_FIELDS
from schemas.wire.part import Part


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "page.md").read_text("utf-8")


@pytest.fixture(scope="module")
def programs(root: Path) -> str:
    return (root / "docs" / "coach_programs.md").read_text("utf-8")


def kinds(*models: type[Part]) -> set[str]:
    return {str(model.__struct_config__.tag) for model in models}


def test_every_datagram_both_ways_has_its_row(programs: str) -> None:
    asked = (
        protocol.Hello,
        protocol.ProgramOrder,
        protocol.ProgramMatchMode,
        protocol.ProgramAction,
        protocol.ProgramEvents,
    )
    said = (protocol.Ack, protocol.Frame, protocol.BeliefUpdate, protocol.EventUpdate, protocol.SessionEnd)
    named = set(re.findall(r"^\| `(\w+)` \|", programs, re.MULTILINE))
    assert kinds(*asked, protocol.KeepAlive, protocol.Bye, *said) <= named


def test_every_match_mode_and_test_mode_has_the_documented_number(programs: str) -> None:
    rows = re.findall(r"^\| (\d+)(?:, (\d+))? \| `(\w+)`(?:, `(\w+)`)? \|", programs, re.MULTILINE)
    said = {int(number): word for row in rows for number, word in zip(row[:2], row[2:], strict=True) if number}
    assert said == {mode.number: mode.value for mode in MatchMode}
    tests = re.search(r"Test modes: (.*?)\.\n", programs, re.DOTALL)
    assert tests is not None
    assert [int(number) for number in re.findall(r"\d+", tests[1])] == list(TEST_MODES)


def test_every_test_stands_in_its_table_with_what_it_needs(programs: str) -> None:
    rows = re.findall(r"^\| `(\w+)` \| (.*?) \|", programs.split("| test | needs |")[1].split("\n\n")[0], re.MULTILINE)
    assert {test: tuple(re.findall(r"`(\w+)`", needs)) for test, needs in rows} == {
        test.value: needs for test, needs in REQUIRED_FIELDS.items()
    }


def test_every_command_of_the_box_is_in_the_table_of_what_becomes_of_it(root: Path) -> None:
    page = (root / "docs" / "coach_programs.md").read_text("utf-8")
    table = page.split("| command | becomes |")[1].split("\n\n")[0]
    assert [name for name in FORWARD if re.search(rf"\b{name}\b", table) is None] == []


def test_the_documented_messages_of_programs_to_the_server_of_the_page_are_valid(page: str) -> None:
    asks = [read_request(line[2:]) for line in page.splitlines() if line.startswith("→ {")]
    assert [ask.deed for ask in asks] == ["action", "action"]


@pytest.mark.parametrize(
    ("row", "deeds"),
    [
        ("order a side, tests too; drive a robot by hand", ("order", "drive")),
        (
            "repair, substitute a robot, have it come back, name the robot that a card is for",
            ("repair", "substitute", "enter", "name_robot"),
        ),
        ("stop, start, restarts, goals, cards, park, undo, end a half", ("stop", "start", "goal", "undo", "end_half")),
        ("place ball and robots, load scenes, change parameters", ("scene", "parameters")),
        ("play, pause and seek a replay", ("replay",)),
    ],
)
def test_who_may_do_what_is_as_the_page_s_server_has_it(row: str, deeds: tuple[str, ...], page: str) -> None:
    (line,) = [line for line in page.splitlines() if line.startswith(f"| {row} |")]
    says = [not cell.strip().startswith("no") for cell in line.strip("|").split("|")[1:]]
    for deed in deeds:
        assert says == [role in RIGHTS[deed] for role in (TokenRole.SPECTATOR, TokenRole.CYAN, TokenRole.REFEREE)]
