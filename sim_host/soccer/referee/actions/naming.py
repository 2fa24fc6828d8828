"""Actions for a side that name no robot: the robots they may concern, and the question to the side's coach."""

from collections.abc import Mapping

from schemas.messages.soccer.game import RefereeAction
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.side import Side
from schemas.soccer.game import ActionName, Card, EventKind
from sim_host.soccer.referee.actions import enter, repair, substitute
from sim_host.soccer.referee.actions.action import Action
from sim_host.soccer.referee.actions.card import card_action
from sim_host.soccer.referee.game.question import ANSWER_S, Question
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.wording import display_name

ROBOT_ACTIONS: Mapping[ActionName, Action] = {
    ActionName.YELLOW_CARD: card_action(Card.YELLOW),
    ActionName.DOUBLE_YELLOW: card_action(Card.YELLOW, second=True),
    ActionName.RED_CARD: card_action(Card.RED),
    ActionName.REPAIR: Action(repair.why_illegal, repair.apply),
    ActionName.SUBSTITUTE: Action(substitute.why_illegal, substitute.apply),
    ActionName.ENTER: Action(enter.why_illegal, enter.apply),
}
"""The actions that a side's coach may be asked to name the robot for."""


def names_no_robot(action: RefereeAction) -> bool:
    """Whether an action concerns a robot of a side, and leaves open which one."""
    return action.robot is None and action.side is not None and action.action in ROBOT_ACTIONS


def for_robot(action: RefereeAction, robot: str) -> RefereeAction:
    """The action for one robot."""
    return RefereeAction(action=action.action, robot=robot, source=action.source)


def possible_robots(draft: RulingDraft, action: RefereeAction) -> tuple[str, ...]:
    """The robots of the action's side that it is allowed for now."""
    return tuple([name for name in _robots_of(draft, action.side) if _why_illegal(draft, action, name) is None])


def why_none(draft: RulingDraft, action: RefereeAction) -> str:
    """Why an action is allowed for no robot of its side."""
    mine = _robots_of(draft, action.side)
    why = _why_illegal(draft, action, mine[-1]) if mine else "it has none"
    return f"it is allowed for no robot of {action.side}: {why}"


def ask(draft: RulingDraft, action: RefereeAction, robots: tuple[str, ...]) -> None:
    """Ask the side of an action which of these robots it concerns."""
    side = action.side
    if side is None:
        return
    question = Question(action.action, side, action.source, robots, _default(draft, robots))
    draft.state = draft.state._replace(questions=(*draft.state.questions, question))
    draft.add_event(
        EventKind.ACTION,
        action.action,
        f"{action.source} requests: {display_name(action.action)} for {side}, no robot is named; "
        f"{side} names it within {ANSWER_S:g} s, otherwise it is {question.default}",
        side=side,
        robots=robots,
        limit=ANSWER_S,
        unit="s",
    )


def why_no_answer(draft: RulingDraft, robot: str) -> str | None:
    """Why naming a robot answers no question, or None."""
    side = draft.match.roster.side_of(robot)
    asked = [question for question in draft.state.questions if question.side is side]
    if not asked:
        return f"{side} is not asked to name a robot"
    reasons = [_why_illegal(draft, _action_of(question), robot) for question in asked]
    return None if None in reasons else f"{display_name(asked[0].action)} for {robot}: {reasons[0]}"


def answer(draft: RulingDraft, robot: str) -> None:
    """Carry out, for this robot, the action of the first question that it answers."""
    side = draft.match.roster.side_of(robot)
    for index, question in enumerate(draft.state.questions):
        action = _action_of(question)
        if question.side is side and _why_illegal(draft, action, robot) is None:
            _remove(draft, index)
            ROBOT_ACTIONS[question.action].apply(draft, for_robot(action, robot))
            return


def decide_overdue(draft: RulingDraft) -> None:
    """Carry out the actions whose robot was not named in time, for the robot that is taken by default."""
    while (index := _overdue(draft)) is not None:
        question = draft.state.questions[index]
        _remove(draft, index)
        action = _action_of(question)
        robots = possible_robots(draft, action)
        what = display_name(question.action)
        if not robots:
            text = f"no {what} for {question.side}: {why_none(draft, action)}"
            draft.add_event(EventKind.ACTION, question.action, text, side=question.side)
            continue
        robot = question.default if question.default in robots else _default(draft, robots)
        text = f"{what} for {robot}: {question.side} has not named a robot within {ANSWER_S:g} s"
        draft.add_event(EventKind.ACTION, question.action, text, side=question.side, robot=robot)
        ROBOT_ACTIONS[question.action].apply(draft, for_robot(action, robot))


def _default(draft: RulingDraft, robots: tuple[str, ...]) -> str:
    """The last offender if it is one of these robots, otherwise the highest number that is no goalkeeper."""
    match, state = draft.match, draft.state
    if state.offender in robots:
        return state.offender
    names = match.roster.names
    keeps = dict(zip(names, match.keepers(state.participation.absences), strict=True))
    numbers = numbers_of(dict(zip(names, match.roster.sides, strict=True)))
    return max(robots, key=lambda name: (not keeps[name], numbers[name]))


def _action_of(question: Question) -> RefereeAction:
    return RefereeAction(action=question.action, side=question.side, source=question.source)


def _why_illegal(draft: RulingDraft, action: RefereeAction, robot: str) -> str | None:
    return ROBOT_ACTIONS[action.action].why_illegal(draft, for_robot(action, robot))


def _robots_of(draft: RulingDraft, side: Side | None) -> list[str]:
    roster = draft.match.roster
    return [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side]


def _overdue(draft: RulingDraft) -> int | None:
    return next((index for index, one in enumerate(draft.state.questions) if reached(0.0, one.left)), None)


def _remove(draft: RulingDraft, index: int) -> None:
    questions = draft.state.questions
    draft.state = draft.state._replace(questions=questions[:index] + questions[index + 1 :])
