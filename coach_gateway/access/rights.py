"""Who may do what from the page: one table of deeds, and whose robots a deed is about. Pure."""

from collections.abc import Mapping
from typing import Any

from coach_gateway.access.roles import COACHES, Role
from coach_gateway.web.protocol import PageAction, PageDrive, PageOrder, PageParameters, PageRequest
from schemas.errors import did_you_mean
from schemas.game import ActionName
from schemas.messages.parameters import ParameterOperation
from schemas.side import Side

_REFEREE = frozenset({Role.REFEREE})
_BENCH = frozenset({Role.REFEREE, *COACHES})

RIGHTS: dict[str, frozenset[Role]] = {
    **dict.fromkeys((action.value for action in ActionName), _REFEREE),
    ActionName.REPAIR.value: _BENCH,
    ActionName.SUBSTITUTE.value: _BENCH,
    ActionName.ENTER.value: _BENCH,
    "order": _BENCH,
    "drive": _BENCH,
    "read_parameters": _BENCH,
    "parameters": _REFEREE,
    "scene": _REFEREE,
    "replay": _REFEREE,
}
"""Deed → the roles that may do it: referee's actions by their names, and what else the page asks for."""

_FOR_A_SIDE = frozenset(
    {ActionName.REPAIR.value, ActionName.SUBSTITUTE.value, ActionName.ENTER.value, "order", "drive"}
)
"""Deeds that a coach may do for its own side alone."""


def deeds_of(role: Role) -> list[str]:
    """What a role may do."""
    return [deed for deed, roles in RIGHTS.items() if role in roles]


def sides_shown(role: Role, *, to_all: bool) -> list[Side]:
    """Whose own affairs, orders or beliefs, a role is shown: a coach never the other side's, unless `to_all`."""
    if to_all or role is Role.REFEREE:
        return list(Side)
    return [COACHES[role]] if role in COACHES else []


def refusal(role: Role, request: PageRequest, robots: Mapping[str, Side]) -> str | None:
    """Why a role may not do what is asked; nothing when it may. `robots` are all that take part, with their sides."""
    deed = _deed(request)
    if deed is None:
        return None
    who = RIGHTS[deed]
    if role not in who:
        need = "the referee's token" if who == _REFEREE else "the token of that side's coach or the referee's"
        return f"{deed.replace('_', ' ')} needs {need}; this page has {_has(role)}"
    if role in COACHES and deed in _FOR_A_SIDE:
        return _why_not_own(COACHES[role], request, robots)
    return None


def _has(role: Role) -> str:
    return "none" if role is Role.SPECTATOR else f"that of {role.value}'s coach"


def _deed(request: PageRequest) -> str | None:
    """The deed as the table names it; nothing for what anybody may request."""
    match request:
        case PageAction():
            return request.action.action.value
        case PageParameters():
            changes = request.request.operation in (ParameterOperation.SET, ParameterOperation.RESET)
            return "parameters" if changes else "read_parameters"
    return None if request.deed == "token" else request.deed


def _why_not_own(own: Side, request: Any, robots: Mapping[str, Side]) -> str | None:
    """Why this is not for the coach of that side."""
    if isinstance(request, PageOrder):
        side: Side | None = request.side
        what = f"an order to {request.side.value}"
    else:
        robot = request.robot if isinstance(request, PageDrive) else request.action.robot
        if robot is None:
            return f"name one of {own.value}'s robots"
        side = robots.get(robot)
        what = robot
        if side is None:
            return f'there is no robot "{robot}"; {did_you_mean(robot, list(robots))}'
    return None if side is own else f"{what} is not for {own.value}'s coach"
