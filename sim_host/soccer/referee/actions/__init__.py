"""The actions that people, coaches and the referee box may request. A new action is a module and a row here."""

from collections.abc import Mapping

from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.soccer.game import ActionName, EventKind, Phase
from sim_host.soccer.referee.actions import (
    cancel_goal,
    confirm,
    end_game,
    end_half,
    goal,
    kick_off,
    name_robot,
    naming,
    overrule,
    park,
    place_ball,
    start,
    stop,
    undo,
)
from sim_host.soccer.referee.actions.action import Action
from sim_host.soccer.referee.actions.ordered_restart import restart_action
from sim_host.soccer.referee.authority import save_for_undo
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.wording import display_name, place_text

ACTIONS: Mapping[ActionName, Action] = {
    **naming.ROBOT_ACTIONS,
    ActionName.START: Action(start.why_illegal, start.apply, can_be_undone=False),
    ActionName.STOP: Action(stop.why_illegal, stop.apply),
    ActionName.KICK_OFF: Action(kick_off.why_illegal, kick_off.apply),
    ActionName.FREE_KICK: restart_action(Phase.FREE_KICK),
    ActionName.GOAL_KICK: restart_action(Phase.GOAL_KICK),
    ActionName.THROW_IN: restart_action(Phase.THROW_IN),
    ActionName.CORNER: restart_action(Phase.CORNER),
    ActionName.PENALTY: restart_action(Phase.PENALTY),
    ActionName.DROP_BALL: restart_action(Phase.DROP_BALL),
    ActionName.PLACE_BALL: Action(place_ball.why_illegal, place_ball.apply, can_be_undone=False),
    ActionName.GOAL: Action(goal.why_illegal, goal.apply),
    ActionName.CANCEL_GOAL: Action(cancel_goal.why_illegal, cancel_goal.apply),
    ActionName.PARK: Action(park.why_illegal, park.apply),
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
