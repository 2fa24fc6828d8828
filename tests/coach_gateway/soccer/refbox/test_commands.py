"""Every command of both protocols of RefBox: characters until 2019, JSON since 2020."""

import json

import pytest

from coach_gateway.soccer.refbox import commands
from coach_gateway.soccer.refbox.commands import NoCommandError
from schemas.messages.soccer.league.signals import BY_CHARACTER
from schemas.side import Side

FOR_BOTH = (
    *("START", "STOP", "DROP_BALL", "PARK", "HALF_TIME", "END_PART", "END_GAME", "GAMEOVER", "FIRST_HALF"),
    *("SECOND_HALF", "FIRST_HALF_OVERTIME", "SECOND_HALF_OVERTIME", "RESET", "TESTMODE_ON", "TESTMODE_OFF"),
)
FOR_ONE = (
    *("WELCOME", "KICKOFF", "FREEKICK", "GOALKICK", "THROWIN", "CORNER", "PENALTY", "GOAL", "SUBGOAL", "REPAIR"),
    *("REPAIR_END", "YELLOW_CARD", "DOUBLE_YELLOW", "RED_CARD"),
)
FOR_ROBOT = ("SUBSTITUTION", "IS_ALIVE")
CHARACTERS = {
    **{"s": "START", "S": "STOP", "W": "WELCOME", "Z": "RESET", "N": "DROP_BALL", "L": "PARK"},
    **{"1": "FIRST_HALF", "2": "SECOND_HALF", "3": "FIRST_HALF_OVERTIME", "4": "SECOND_HALF_OVERTIME"},
    **{"h": "HALF_TIME", "e": "END_GAME", "z": "GAMEOVER", "U": "TESTMODE_ON", "u": "TESTMODE_OFF"},
    **{"H": "HALT", " ": "READY", "x": "CANCEL", "n": "RESTART"},
}
SIDED = {
    **{"K": "KICKOFF", "F": "FREEKICK", "G": "GOALKICK", "T": "THROWIN", "C": "CORNER", "P": "PENALTY", "A": "GOAL"},
    **{"D": "SUBGOAL", "Y": "YELLOW_CARD", "B": "DOUBLE_YELLOW", "R": "RED_CARD", "O": "REPAIR", "I": "REPAIR_END"},
}
"""Capital letters are cyan's."""


@pytest.mark.parametrize("name", [*FOR_BOTH, *FOR_ONE, *FOR_ROBOT])
def test_every_command_is_read_and_written(name: str) -> None:
    target = "" if name in FOR_BOTH else "224.16.32.44"
    robot = 3 if name in FOR_ROBOT else None
    said = {"command": name, "targetTeam": target} | ({"robotID": robot} if robot is not None else {})
    command = commands.read(said)
    assert (command.signal.name, command.target, command.robot) == (name, target, robot)
    written = commands.write(command)
    assert written.endswith(b"\x00")
    assert json.loads(written[:-1]) == said


@pytest.mark.parametrize(("character", "name"), CHARACTERS.items())
def test_every_character_is_read_and_written(character: str, name: str) -> None:
    signal, side = BY_CHARACTER[character]
    assert (signal.name, side, signal.character_for(None)) == (name, None, character)


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize(("character", "name"), SIDED.items())
def test_capital_letters_are_cyans_and_small_ones_magentas(character: str, name: str, side: Side) -> None:
    spelled = character if side is Side.CYAN else character.lower()
    signal, whose = BY_CHARACTER[spelled]
    assert (signal.name, whose, signal.character_for(side)) == (name, side, spelled)


@pytest.mark.parametrize("name", ["END_PART", "SUBSTITUTION", "IS_ALIVE"])
def test_what_came_with_json_has_no_character(name: str) -> None:
    assert commands.read({"command": name}).signal.character_for(Side.CYAN) == ""


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ({"command": "GAME_OVER", "targetTeam": ""}, "GAMEOVER"),  # as the league's document has it
        ({"command": "kick-off", "targetTeam": "a"}, "KICKOFF"),
        ({"Command": "Drop Ball", "TargetTeam": ""}, "DROP_BALL"),
        ({"command": "first_half", "extra": [1]}, "FIRST_HALF"),
        ({"command": "GOAL", "targetTeam": None}, "GOAL"),
    ],
)
def test_spellings_do_not_matter(said: dict[str, object], name: str) -> None:
    assert commands.read(said).signal.name == name


@pytest.mark.parametrize(
    ("value", "robot"),
    [*((none, None) for none in (-1, None, "-1", "", "two", True, 2.5, [1], 10**40)), (3, 3), ("3", 3), (3.0, 3)],
)
def test_a_robot_may_be_written_as_text_and_one_that_is_none_is_no_robot(value: object, robot: int | None) -> None:
    assert commands.read({"command": "REPAIR", "targetTeam": "a", "robotID": value}).robot == robot


@pytest.mark.parametrize("said", [{}, {"command": 3}, {"command": "DANCE"}, {"type": "worldstate"}])
def test_an_object_without_a_command_is_an_error_with_the_reason(said: dict[str, object]) -> None:
    with pytest.raises(NoCommandError):
        commands.read(said)
