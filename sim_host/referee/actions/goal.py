"""Goal: counts one for a side by the word of a person, and the other side kicks off.

In a shoot-out it ends the attempt of the side that takes it, with a goal.
"""

from schemas.game import EventKind, RefereeAction, Stage
from sim_host.referee import flow
from sim_host.referee.actions.legality import no_half, no_side, no_such_robot
from sim_host.referee.decision import Decision
from sim_host.referee.turn import Turn


def why_illegal(turn: Turn, action: RefereeAction) -> str | None:
    """A reason against it, or nothing."""
    return no_half(turn) or no_side(action) or no_such_robot(turn, action) or _not_its_penalty(turn, action)


def apply(turn: Turn, action: RefereeAction) -> None:
    """Count the goal."""
    side = action.side
    if side is None:
        return
    if turn.state.stage is Stage.SHOOT_OUT:
        text = f"penalty of {side} scored by the word of {action.source}"
        shot = Decision(EventKind.SHOT, text, shot_scored=True, side=side, robot=action.robot)
        flow.carry_out(turn, action.action, shot)
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


def _not_its_penalty(turn: Turn, action: RefereeAction) -> str | None:
    """In a shoot-out, the side that takes the penalty scores, after START."""
    state = turn.state
    if state.stage is not Stage.SHOOT_OUT or (state.running and state.side is action.side):
        return None
    return f"{action.side} is taking no penalty of the shoot-out just now"
