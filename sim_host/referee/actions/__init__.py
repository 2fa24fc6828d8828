"""The actions that people, coaches and the referee box may request. A new action is a module and a row here."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from schemas.game import ActionName, EventKind
from schemas.messages.game import ActionReply, RefereeAction
from sim_host.referee.actions import (
    cancel_goal,
    confirm,
    corner,
    double_yellow,
    drop_ball,
    end_game,
    end_half,
    enter,
    free_kick,
    goal,
    goal_kick,
    kick_off,
    name_robot,
    naming,
    overrule,
    park,
    penalty,
    place_ball,
    red_card,
    repair,
    start,
    stop,
    substitute,
    throw_in,
    undo,
    yellow_card,
)
from sim_host.referee.authority import save_for_undo
from sim_host.referee.ruling_draft import RulingDraft
from sim_host.referee.wording import display_name, place_text


@dataclass(frozen=True, slots=True)
class Action:
    """One row: a check whether the action is legal in this tick, and its effect."""

    why_illegal: Callable[[RulingDraft, RefereeAction], str | None]
    apply: Callable[[RulingDraft, RefereeAction], None]
    can_be_undone: bool = True
    """It is a decision; the other actions only let the game go on, or decide on a proposal."""


ACTIONS: Mapping[ActionName, Action] = {
    ActionName.START: Action(start.why_illegal, start.apply, can_be_undone=False),
    ActionName.STOP: Action(stop.why_illegal, stop.apply),
    ActionName.KICK_OFF: Action(kick_off.why_illegal, kick_off.apply),
    ActionName.FREE_KICK: Action(free_kick.why_illegal, free_kick.apply),
    ActionName.GOAL_KICK: Action(goal_kick.why_illegal, goal_kick.apply),
    ActionName.THROW_IN: Action(throw_in.why_illegal, throw_in.apply),
    ActionName.CORNER: Action(corner.why_illegal, corner.apply),
    ActionName.PENALTY: Action(penalty.why_illegal, penalty.apply),
    ActionName.DROP_BALL: Action(drop_ball.why_illegal, drop_ball.apply),
    ActionName.PLACE_BALL: Action(place_ball.why_illegal, place_ball.apply, can_be_undone=False),
    ActionName.GOAL: Action(goal.why_illegal, goal.apply),
    ActionName.CANCEL_GOAL: Action(cancel_goal.why_illegal, cancel_goal.apply),
    ActionName.YELLOW_CARD: Action(yellow_card.why_illegal, yellow_card.apply),
    ActionName.DOUBLE_YELLOW: Action(double_yellow.why_illegal, double_yellow.apply),
    ActionName.RED_CARD: Action(red_card.why_illegal, red_card.apply),
    ActionName.REPAIR: Action(repair.why_illegal, repair.apply),
    ActionName.SUBSTITUTE: Action(substitute.why_illegal, substitute.apply),
    ActionName.PARK: Action(park.why_illegal, park.apply),
    ActionName.ENTER: Action(enter.why_illegal, enter.apply),
    ActionName.NAME_ROBOT: Action(name_robot.why_illegal, name_robot.apply),
    ActionName.CONFIRM: Action(confirm.why_illegal, confirm.apply, can_be_undone=False),
    ActionName.OVERRULE: Action(overrule.why_illegal, overrule.apply, can_be_undone=False),
    ActionName.UNDO: Action(undo.why_illegal, undo.apply, can_be_undone=False),
    ActionName.END_HALF: Action(end_half.why_illegal, end_half.apply),
    ActionName.END_GAME: Action(end_game.why_illegal, end_game.apply),
}
"""Name → the check and the effect of the action."""


def execute(draft: RulingDraft, action: RefereeAction) -> ActionReply:
    """Carry out an action, or refuse it with the reason; if it may concern several robots of a side, ask which one."""
    if naming.names_no_robot(action):
        robots = naming.possible_robots(draft, action)
        if not robots:
            return _refused(draft, action, naming.why_none(draft, action))
        if len(robots) > 1:
            naming.ask(draft, action, robots)
            return ActionReply(accepted=True, tick=draft.snapshot.tick)
        action = naming.for_robot(action, robots[0])
    row = ACTIONS[action.action]
    reason = row.why_illegal(draft, action)
    if reason is not None:
        return _refused(draft, action, reason)
    place = (action.place.x, action.place.y) if action.place is not None else None
    owner = f" for {action.side}" if action.side is not None else ""
    where = f" at {place_text(place)}" if place is not None else ""
    who = f" for {action.robot}" if action.robot is not None and action.side is None else ""
    text = f"{action.source} requests: {display_name(action.action)}{owner}{who}{where}"
    draft.add_event(EventKind.ACTION, action.action, text, side=action.side, robot=action.robot, place=place)
    if row.can_be_undone:
        save_for_undo(draft)
    row.apply(draft, action)
    return ActionReply(accepted=True, tick=draft.snapshot.tick)


def _refused(draft: RulingDraft, action: RefereeAction, reason: str) -> ActionReply:
    return ActionReply(accepted=False, reason=f"{action.action}: {reason}", tick=draft.snapshot.tick)
