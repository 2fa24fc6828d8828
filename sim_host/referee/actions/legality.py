"""The questions that several actions ask before they may be done; each answers with a reason against it, or nothing."""

from schemas.game import Phase, RefereeAction
from sim_host.referee.flow import HALF_ON
from sim_host.referee.turn import Turn
from sim_host.referee.wording import at, spoken

FIXED = frozenset({Phase.KICK_OFF, Phase.PENALTY})
"""Restarts whose spot the rules name."""


def no_half(turn: Turn) -> str | None:
    """A half must be being played."""
    if turn.state.phase in HALF_ON:
        return None
    return f"no half is being played, the phase is {turn.state.phase}"


def no_side(action: RefereeAction) -> str | None:
    """A side must be named."""
    return None if action.side is not None else "no side is named; name cyan or magenta"


def a_side(action: RefereeAction) -> str | None:
    """No side may be named."""
    return None if action.side is None else f"it belongs to nobody, yet {action.side} is named; leave the side out"


def bad_place(turn: Turn, action: RefereeAction) -> str | None:
    """A place, if named, must lie on the field."""
    pitch, place = turn.match.pitch, action.place
    if place is None or (abs(place.x) <= pitch.goal_line and abs(place.y) <= pitch.touch_line):
        return None
    return (
        f"{at((place.x, place.y))} is outside the field; |x| is at most {pitch.goal_line:g} m, "
        f"|y| at most {pitch.touch_line:g} m"
    )


def a_place(action: RefereeAction, phase: Phase) -> str | None:
    """No place may be named for a restart that has one spot."""
    if action.place is None:
        return None
    return f"the spot of a {spoken(phase)} is fixed, yet a place is named; leave the place out"


def no_such_robot(turn: Turn, action: RefereeAction) -> str | None:
    """A robot, if named, must take part."""
    names = turn.match.roster.names
    if action.robot is None or action.robot in names:
        return None
    return f"{action.robot} does not play; the robots are {', '.join(names)}"
