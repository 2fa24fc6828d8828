"""Roles × deeds: the whole table, and whose robots a coach may touch."""

from typing import Any

import pytest

from coach_gateway.access.rights import RIGHTS, deeds_of, refusal, sides_shown
from coach_gateway.access.roles import Role
from coach_gateway.web.protocol import PAGE_REQUEST
from schemas.game import ActionName
from schemas.side import Side

ROBOTS = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta1": Side.MAGENTA}
OWN = ("repair", "substitute", "enter")
"""Actions that a coach may ask for, for its own robots."""


def asked(deed: str, **content: Any) -> Any:
    return PAGE_REQUEST.validate_python({"id": 1, "deed": deed, **content})


EVERY_ASK = {
    **{name.value: asked("action", action={"action": name, "robot": "cyan1"}) for name in ActionName},
    "order": asked("order", side="cyan", order={}),
    "drive": asked("drive", robot="cyan1", manual={}),
    "scene": asked("scene", request={"operation": "reset"}),
    "parameters": asked("parameters", request={"operation": "reset"}),
    "read_parameters": asked("parameters", request={"operation": "list"}),
    "replay": asked("replay", request={}),
}
"""Deed → a message that asks for it, about cyan where it is about a side."""


def allowed(role: Role) -> list[str]:
    return sorted(deed for deed, ask in EVERY_ASK.items() if refusal(role, ask, ROBOTS) is None)


def test_the_table_has_every_deed_that_can_be_asked_for() -> None:
    assert sorted(RIGHTS) == sorted(EVERY_ASK)


@pytest.mark.parametrize(
    ("role", "deeds"),
    [
        (Role.SPECTATOR, []),
        (Role.REFEREE, sorted(EVERY_ASK)),
        (Role.CYAN, sorted([*OWN, "order", "drive", "read_parameters"])),
        (Role.MAGENTA, ["read_parameters"]),
    ],
)
def test_each_role_may_do_what_the_table_says_to_cyan_and_no_more(role: Role, deeds: list[str]) -> None:
    assert allowed(role) == deeds


@pytest.mark.parametrize("role", list(Role))
def test_a_page_is_told_the_deeds_that_its_role_may_do(role: Role) -> None:
    told = set(deeds_of(role))
    assert told >= set(allowed(role))
    refused = [deed for deed, ask in EVERY_ASK.items() if deed not in told and refusal(role, ask, ROBOTS) is None]
    assert refused == []


@pytest.mark.parametrize(
    ("ask", "why"),
    [
        (asked("order", side="magenta", order={"mode": "hold"}), "an order to magenta is not for cyan's coach"),
        (asked("drive", robot="magenta1", manual={}), "magenta1 is not for cyan's coach"),
        (asked("drive", robot="cyan7", manual={}), 'there is no robot "cyan7"; did you mean "cyan'),
        (asked("action", action={"action": "repair", "robot": "magenta1"}), "magenta1 is not for cyan's coach"),
        (asked("action", action={"action": "repair"}), "name one of cyan's robots"),
        (asked("action", action={"action": "repair", "side": "cyan"}), "name one of cyan's robots"),
        (asked("action", action={"action": "stop"}), "stop needs the referee's token; this page has that of cyan's"),
        (asked("scene", request={"operation": "reset"}), "scene needs the referee's token"),
    ],
)
def test_cyan_s_coach_is_told_why_something_is_not_for_it(ask: Any, why: str) -> None:
    assert (refusal(Role.CYAN, ask, ROBOTS) or "").startswith(why)


def test_anybody_may_ask_what_a_token_is_worth() -> None:
    assert [refusal(role, asked("token"), ROBOTS) for role in Role] == [None] * 4


@pytest.mark.parametrize(
    ("role", "to_all", "sides"),
    [
        (Role.SPECTATOR, False, []),
        (Role.SPECTATOR, True, [Side.CYAN, Side.MAGENTA]),
        (Role.CYAN, False, [Side.CYAN]),
        (Role.MAGENTA, False, [Side.MAGENTA]),
        (Role.MAGENTA, True, [Side.CYAN, Side.MAGENTA]),
        (Role.REFEREE, False, [Side.CYAN, Side.MAGENTA]),
    ],
)
def test_what_is_a_team_s_own_is_shown_to_it_and_to_the_referee(role: Role, to_all: bool, sides: list[Side]) -> None:
    assert sides_shown(role, to_all=to_all) == sides
