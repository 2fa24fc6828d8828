"""Conditions that several actions share; each check returns why the action is illegal, or None."""

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import GameStage, Phase
from sim_host.soccer.referee.game.participation import SUSPENSIONS
from sim_host.soccer.referee.procedures.discipline import reason_text
from sim_host.soccer.referee.procedures.periods import HALF_PHASES
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.wording import display_name, place_text

FIXED = frozenset({Phase.KICK_OFF, Phase.PENALTY})
"""Restarts with a spot that the rules fix."""


def no_half(draft: RulingDraft) -> str | None:
    """A half must be in progress."""
    if draft.state.phase in HALF_PHASES:
        return None
    return f"no half is in progress, the phase is {draft.state.phase}"


def no_match(draft: RulingDraft) -> str | None:
    """The match must have begun and not be over."""
    if draft.state.phase not in (Phase.PRE_GAME, Phase.FULL_TIME):
        return None
    return f"no match is in progress, the phase is {draft.state.phase}"


def in_shoot_out(draft: RulingDraft) -> str | None:
    """There must not be a penalty shoot-out."""
    return "the penalty shoot-out is on" if draft.state.stage is GameStage.SHOOT_OUT else None


def no_robot(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A robot must be named, and take part; a side that is named, too, must be its side."""
    roster = draft.match.roster
    if action.robot is None:
        return f"no robot is named; name one of {', '.join(roster.names)}"
    if action.robot in roster.names and action.side not in (None, roster.side_of(action.robot)):
        return f"{action.robot} does not play for {action.side}, which is named; leave the side out"
    return no_such_robot(draft, action)


def named_robot(action: RefereeAction) -> str:
    """The robot that an action names; `no_robot` checks that it names one.

    Raises:
        ValueError: the action names no robot.
    """
    if action.robot is None:
        raise ValueError(f"{action.action} names no robot")
    return action.robot


def is_away(draft: RulingDraft, robot: str) -> bool:
    """Whether a robot is off the field."""
    return robot in draft.state.participation.absences


def off_field(draft: RulingDraft, action: RefereeAction) -> str | None:
    """The robot must be on the field."""
    away = draft.state.participation.absences.get(named_robot(action))
    return None if away is None else f"{action.robot} is off the field already: {reason_text(away.why)}"


def sent_off(draft: RulingDraft, action: RefereeAction) -> str | None:
    """The robot must not be sent off for good."""
    away = draft.state.participation.absences.get(named_robot(action))
    return f"{action.robot} is sent off for good" if away is not None and away.for_good else None


def suspended(draft: RulingDraft, action: RefereeAction) -> str | None:
    """The robot must not be suspended: its time off would end with another reason."""
    away = draft.state.participation.absences.get(named_robot(action))
    if away is None or away.left is None or away.why not in SUSPENSIONS:
        return None
    return f"{action.robot} is off the field for {away.left:.0f} s more: {reason_text(away.why)}"


def no_proposal(draft: RulingDraft) -> str | None:
    """There must be a proposal."""
    return None if draft.state.proposal is not None else "there is no proposal"


def no_side(action: RefereeAction) -> str | None:
    """A side must be named."""
    return None if action.side is not None else "no side is named; name cyan or magenta"


def has_side(action: RefereeAction) -> str | None:
    """No side may be named."""
    return None if action.side is None else f"neither side takes it, but {action.side} is named; leave the side out"


def bad_place(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A place, if named, must be on the field."""
    pitch, place = draft.match.pitch, action.place
    if place is None or (abs(place.x) <= pitch.goal_line and abs(place.y) <= pitch.touch_line):
        return None
    return (
        f"{place_text((place.x, place.y))} is outside the field; |x| is at most {pitch.goal_line:g} m, "
        f"|y| at most {pitch.touch_line:g} m"
    )


def place_is_fixed(action: RefereeAction, phase: Phase) -> str | None:
    """No place may be named for a restart that has one spot."""
    if action.place is None:
        return None
    return f"the spot of a {display_name(phase)} is fixed, but a place is named; leave the place out"


def no_such_robot(draft: RulingDraft, action: RefereeAction) -> str | None:
    """A robot, if named, must take part."""
    names = draft.match.roster.names
    if action.robot is None or action.robot in names:
        return None
    return f"{action.robot} does not take part; the robots are {', '.join(names)}"
