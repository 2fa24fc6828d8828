"""Which role may do which deed, as one table; a coach may do some deeds for its own side alone. Pure."""

from collections.abc import Mapping

from coach_gateway.access.roles import COACHES, TokenRole
from schemas.errors import did_you_mean
from schemas.messages.setup import Setup
from schemas.side import Side
from schemas.soccer.game import ActionName

_REFEREE = frozenset({TokenRole.REFEREE})
_BENCH = frozenset({TokenRole.REFEREE, *COACHES})

RIGHTS: dict[str, frozenset[TokenRole]] = {
    **dict.fromkeys((action.value for action in ActionName), _REFEREE),
    ActionName.REPAIR.value: _BENCH,
    ActionName.SUBSTITUTE.value: _BENCH,
    ActionName.ENTER.value: _BENCH,
    ActionName.NAME_ROBOT.value: _BENCH,
    "order": _BENCH,
    "drive": _BENCH,
    "read_parameters": _BENCH,
    "parameters": _REFEREE,
    "scene": _REFEREE,
    "replay": _REFEREE,
    "referee_seat": _REFEREE,
}
"""Deed → the roles that may do it: the referee's actions by name, and other requests of the page."""

_FOR_A_SIDE = frozenset(
    {
        *(ActionName.REPAIR.value, ActionName.SUBSTITUTE.value, ActionName.ENTER.value, ActionName.NAME_ROBOT.value),
        *("order", "drive"),
    }
)
"""Deeds that a coach may do for its own side alone."""


_OF_A_REFEREE = frozenset({*(action.value for action in ActionName), "referee_seat"})


def deeds_of(role: TokenRole, setup: Setup | None = None) -> list[str]:
    """The deeds of a role; a free game has no referee."""
    hidden = _OF_A_REFEREE if setup is not None and setup.free is not None else frozenset()
    return [deed for deed, roles in RIGHTS.items() if role in roles and deed not in hidden]


def sides_shown(role: TokenRole, *, to_all: bool) -> list[Side]:
    """The sides whose orders, beliefs or drawings a role is shown: a coach only its own, unless `to_all`."""
    if to_all or role is TokenRole.REFEREE:
        return list(Side)
    return [COACHES[role]] if role in COACHES else []


def refusal(
    role: TokenRole, deed: str, robots: Mapping[str, Side], *, side: Side | None = None, robot: str | None = None
) -> str | None:
    """Why a role may not do a deed of `RIGHTS`; None when it may.

    `side` is the side that an order is for, `robot` the robot that any other deed is about. `robots` are all robots of
    the match with their sides.
    """
    allowed = RIGHTS[deed]
    if role not in allowed:
        need = "the referee's token" if allowed == _REFEREE else "the token of that side's coach or the referee's"
        has = "none" if role is TokenRole.SPECTATOR else f"that of {role.value}'s coach"
        return f"{deed.replace('_', ' ')} needs {need}; this page has {has}"
    if role in COACHES and deed in _FOR_A_SIDE:
        return _refusal_of_other_side(COACHES[role], robots, side, robot)
    return None


def _refusal_of_other_side(own: Side, robots: Mapping[str, Side], side: Side | None, robot: str | None) -> str | None:
    """Why a deed for this side or about this robot is not for the coach of `own`; None when it is."""
    if side is not None:
        subject = f"an order to {side.value}"
    elif robot is None:
        return f"name one of {own.value}'s robots"
    elif robot in robots:
        side, subject = robots[robot], robot
    else:
        return f'there is no robot "{robot}"; {did_you_mean(robot, list(robots))}'
    return None if side is own else f"{subject} is not for {own.value}'s coach"
