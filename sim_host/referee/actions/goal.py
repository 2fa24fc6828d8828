"""Goal: counts one for a side by the word of a person, and the other side kicks off."""

from schemas.game import EventKind, RefereeAction
from sim_host.referee import flow
from sim_host.referee.actions.legality import no_half, no_side, no_such_robot
from sim_host.referee.decision import Decision
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_half(turn) or no_side(action) or no_such_robot(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Count the goal."""
    side = action.side
    if side is None:
        return
    decision = Decision(
        kind=EventKind.GOAL,
        text=f"goal for {side} by the word of {action.source}",
        restart=flow.kick_off_after_goal(side),
        goal_for=side,
        side=side,
        robot=action.robot,
    )
    flow.carry_out(turn, action.action, decision)
