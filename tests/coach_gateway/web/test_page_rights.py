"""Which deed each message of the page is, and which side or robot it is about."""

import json
from typing import Any

import pytest

from coach_gateway.access.rights import RIGHTS
from coach_gateway.access.roles import TokenRole
from coach_gateway.web.pages.protocol import read_request
from coach_gateway.web.pages.requests import refusal
from schemas.side import Side
from schemas.soccer.game import ActionName

ROBOTS = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta1": Side.MAGENTA}


def request(deed: str, **content: Any) -> Any:
    return read_request(json.dumps({"id": 1, "deed": deed, **content}))


EVERY_REQUEST = {
    **{name.value: request("action", action={"action": name, "robot": "cyan1"}) for name in ActionName},
    "order": request("order", side="cyan", order={}),
    "drive": request("drive", robot="cyan1", manual={}),
    "scene": request("scene", request={"operation": "reset"}),
    "parameters": request("parameters", request={"operation": "reset"}),
    "read_parameters": request("parameters", request={"operation": "list"}),
    "replay": request("replay", request={}),
    "referee_seat": request("referee_seat", operation="take"),
}
"""Deed → a message that asks for it."""


def test_the_page_can_ask_for_every_deed_of_the_table() -> None:
    assert sorted(RIGHTS) == sorted(EVERY_REQUEST)


@pytest.mark.parametrize("deed", list(EVERY_REQUEST))
def test_a_spectator_is_refused_every_deed_by_its_name(deed: str) -> None:
    assert (refusal(TokenRole.SPECTATOR, EVERY_REQUEST[deed], ROBOTS) or "").startswith(
        f"{deed.replace('_', ' ')} needs "
    )


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (request("order", side="magenta", order={"mode": "hold"}), "an order to magenta is not for cyan's coach"),
        (request("drive", robot="magenta1", manual={}), "magenta1 is not for cyan's coach"),
        (request("action", action={"action": "repair", "robot": "magenta1"}), "magenta1 is not for cyan's coach"),
        (request("action", action={"action": "repair", "side": "cyan"}), "name one of cyan's robots"),
        (request("order", side="cyan", order={"mode": "hold"}), None),
        (request("drive", robot="cyan2", manual={}), None),
        (request("action", action={"action": "repair", "robot": "cyan1"}), None),
    ],
)
def test_a_message_of_cyan_s_coach_is_refused_for_the_other_side(message: Any, reason: str | None) -> None:
    assert refusal(TokenRole.CYAN, message, ROBOTS) == reason
