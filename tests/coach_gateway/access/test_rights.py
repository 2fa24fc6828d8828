"""Roles × deeds: the whole table, and which robots a coach may command."""

from pathlib import Path

import pytest

from coach_gateway.access.rights import RIGHTS, deeds_of, refusal, sides_shown
from coach_gateway.access.roles import TokenRole
from schemas.messages.setup import Setup
from schemas.side import Side
from support.free_match import free_match

ROBOTS = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta1": Side.MAGENTA}
OWN = ("repair", "substitute", "enter", "name_robot")
"""Actions that a coach may ask for, for its own robots."""


def refusal_about_cyan(role: TokenRole, deed: str) -> str | None:
    if deed == "order":
        return refusal(role, deed, ROBOTS, side=Side.CYAN)
    return refusal(role, deed, ROBOTS, robot="cyan1")


def allowed(role: TokenRole) -> list[str]:
    return sorted(deed for deed in RIGHTS if refusal_about_cyan(role, deed) is None)


@pytest.mark.parametrize(
    ("role", "deeds"),
    [
        (TokenRole.SPECTATOR, []),
        (TokenRole.REFEREE, sorted(RIGHTS)),
        (TokenRole.CYAN, sorted([*OWN, "order", "drive", "read_parameters"])),
        (TokenRole.MAGENTA, ["read_parameters"]),
    ],
)
def test_each_role_has_exactly_the_rights_of_the_table_over_cyan(role: TokenRole, deeds: list[str]) -> None:
    assert allowed(role) == deeds


@pytest.mark.parametrize("role", list(TokenRole))
def test_the_deeds_of_a_role_are_those_it_is_not_refused(role: TokenRole) -> None:
    shown = set(deeds_of(role))
    assert shown >= set(allowed(role))
    assert [deed for deed in RIGHTS if deed not in shown and refusal_about_cyan(role, deed) is None] == []


@pytest.mark.parametrize(
    ("deed", "side", "robot", "reason"),
    [
        ("order", Side.MAGENTA, None, "an order to magenta is not for cyan's coach"),
        ("drive", None, "magenta1", "magenta1 is not for cyan's coach"),
        ("drive", None, "cyan7", 'there is no robot "cyan7"; did you mean "cyan'),
        ("repair", None, None, "name one of cyan's robots"),
        ("stop", None, None, "stop needs the referee's token; this page has that of cyan's"),
        ("scene", None, None, "scene needs the referee's token"),
    ],
)
def test_a_refusal_of_cyan_s_coach_has_its_reason(deed: str, side: Side | None, robot: str | None, reason: str) -> None:
    assert (refusal(TokenRole.CYAN, deed, ROBOTS, side=side, robot=robot) or "").startswith(reason)


@pytest.mark.parametrize(
    ("role", "to_all", "sides"),
    [
        (TokenRole.SPECTATOR, False, []),
        (TokenRole.SPECTATOR, True, [Side.CYAN, Side.MAGENTA]),
        (TokenRole.CYAN, False, [Side.CYAN]),
        (TokenRole.MAGENTA, False, [Side.MAGENTA]),
        (TokenRole.MAGENTA, True, [Side.CYAN, Side.MAGENTA]),
        (TokenRole.REFEREE, False, [Side.CYAN, Side.MAGENTA]),
    ],
)
def test_what_is_a_team_s_own_is_shown_to_it_and_to_the_referee(
    role: TokenRole, to_all: bool, sides: list[Side]
) -> None:
    assert sides_shown(role, to_all=to_all) == sides


def test_a_free_game_has_no_deeds_of_a_referee(tmp_path: Path) -> None:
    match = free_match(tmp_path)
    setup = Setup.of(match, match.load_profile(), match.load_rule_book())
    left = {"order", "drive", "read_parameters", "parameters", "scene", "replay"}
    assert set(deeds_of(TokenRole.REFEREE, setup)) == left
    assert set(deeds_of(TokenRole.CYAN, setup)) == {"order", "drive", "read_parameters"}
