"""Advantage: after a foul, play goes on for the side that suffered it, as long as that side keeps the ball.

It is played if the rule book or the match file sets a time for it, the foul earns a free kick, and that side is in
control of the ball and holds it or has the robot nearest to it. The foul is an event at once. If the side loses the
ball within the time, the foul is decided as if it had been called. If it keeps the ball, the advantage has been used,
and the foul earns no restart any more. The same holds if the game is stopped for the side's benefit meanwhile: by its
goal, another foul of the offenders, or a ball out that leaves it the ball. Any other stop by a rule, such as the side's
own foul or a goal of the offenders, gives it the restart for the first foul. A card for the foul is shown at the next
stop in any case, also if the half ends or people stop the game. In mixed officiating, the foul is proposed when the
side has lost the ball.

Section: the referee's powers: advantage.
Measures: the side in control of the ball, and the time since the foul.
Not judged: how promising the attack is; a foul that earns a penalty or a red card is decided at once.
"""

import dataclasses
import math

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, GameStage, Phase
from sim_host.soccer.referee.game.advantage import Advantage
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.procedures import discipline, offences
from sim_host.soccer.referee.ruling_draft import RulingDraft


def is_played(draft: RulingDraft, decision: Decision) -> bool:
    """Whether play goes on after a foul that has been found in this tick."""
    restart, state = decision.restart, draft.state
    if not draft.match.advantage or decision.kind is not EventKind.FOUL or decision.card is Card.RED:
        return False
    if restart is None or restart.side is None or restart.phase is not Phase.FREE_KICK:
        return False
    if state.phase is not Phase.PLAY or state.stage is GameStage.SHOOT_OUT or decision.side is restart.side:
        return False
    return _has_prospect(draft, restart.side)


def note(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Note a foul, and let play go on."""
    if decision.restart is None or decision.restart.side is None:
        return
    noted = Advantage(rule, decision, decision.restart.side, draft.match.advantage)
    draft.state = draft.state._replace(advantage=noted, offender=decision.robot or draft.state.offender)
    draft.add_decision_event(
        EventKind.ADVANTAGE, rule, decision, f"advantage for {noted.side}, {noted.left:g} s: {decision.text}"
    )


def resolve(draft: RulingDraft, found: tuple[str, Decision] | None) -> tuple[str, Decision] | None:
    """What is decided in this tick while an advantage is played; `found` is the decision of a rule, if there is one."""
    noted = draft.state.advantage
    if noted is None:
        return found
    if found is not None:
        if _is_good_for(noted.side, found[1]):
            end(draft)
            return found
        _owe_card_for(draft, *found)
        return _decide_foul(draft, noted)
    if _has_lost_ball(draft, noted.side):
        return _decide_foul(draft, noted)
    if reached(0.0, noted.left):
        end(draft)
        text = f"{noted.side} has used its advantage after the foul of {noted.decision.robot}"
        draft.add_event(EventKind.ADVANTAGE, noted.rule, text, side=noted.side)
    return None


def end(draft: RulingDraft) -> None:
    """End the advantage, if there is one, without a restart for the foul; its card is shown at the next stop."""
    noted = draft.state.advantage
    if noted is not None:
        draft.state = draft.state._replace(advantage=None)
        offences.count(draft, noted.rule, noted.decision.robot)
        _owe_card(draft, noted.rule, noted.decision)


def _decide_foul(draft: RulingDraft, noted: Advantage) -> tuple[str, Decision]:
    """The decision on the foul, after its advantage is lost."""
    draft.state = draft.state._replace(advantage=None)
    passed = draft.match.advantage - noted.left
    text = f"{noted.decision.text}; {noted.side} lost its advantage after {passed:.1f} s"
    return noted.rule, dataclasses.replace(noted.decision, text=text)


def _owe_card_for(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Keep the card of a foul that is not decided because an earlier one is."""
    if decision.kind is EventKind.FOUL:
        offences.count(draft, rule, decision.robot)
        _owe_card(draft, rule, decision)


def _owe_card(draft: RulingDraft, rule: str, decision: Decision) -> None:
    if decision.card is not None and decision.robot is not None:
        discipline.owe_card(draft, rule, decision.robot, decision.card)


def _is_good_for(side: Side, decision: Decision) -> bool:
    """Whether a decision is in favour of a side, or ends the half."""
    if decision.ends_half or decision.goal_for is side:
        return True
    return decision.goal_for is None and decision.restart is not None and decision.restart.side is side


def _has_prospect(draft: RulingDraft, side: Side) -> bool:
    """Whether a side is in control and holds the ball, or has the robot nearest to it."""
    roster, snapshot = draft.match.roster, draft.snapshot
    if draft.state.evidence.play.control is not side:
        return False
    if snapshot.possession is not None:
        return roster.side_of(snapshot.possession) is side
    away, ball = draft.state.participation.absences, (snapshot.ball.x, snapshot.ball.y)
    nearest = {
        one: min(
            math.dist((robot.x, robot.y), ball)
            for name, its, robot in zip(roster.names, roster.sides, snapshot.robots, strict=True)
            if its is one and name not in away
        )
        for one in Side
        if any(its is one and name not in away for name, its in zip(roster.names, roster.sides, strict=True))
    }
    return side in nearest and all(nearest[side] <= distance for distance in nearest.values())


def _has_lost_ball(draft: RulingDraft, side: Side) -> bool:
    holder = draft.snapshot.possession
    if holder is not None and draft.match.roster.side_of(holder) is not side:
        return True
    return draft.state.evidence.play.control is not side
