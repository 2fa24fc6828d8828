"""A league's referee box that officiates: it alone ends halves, breaks, extra time, the shoot-out and the match.

While a box is connected, no rule of time ends any of them, no side forfeits, and a shoot-out goes on until the box ends
it. The game clock runs on beyond the time of the half. A restart of the box stays until it is taken or replaced. A
yellow card is only counted: the box decides which one is the second, and sends the robot off. START begins the next
period; after the second half that is extra time, after extra time the shoot-out. After the last half that the match
requires, the match is over as soon as the robots have parked, unless the box has begun extra time by then.

When the box has been gone for 10 s of simulated time, the rules of time apply again: a half or a break whose time is up
by then ends at once, any other one when its time is up.

A card, repair, return or substitution for a side that names no robot opens a question: the side's coach has 10 s of
simulated time to name the robot. Without an answer it is the robot that committed the last foul, if that is one of this
side, otherwise the one with the highest number that is no goalkeeper. The action has to be allowed for the robot; if it
is allowed for one robot only, no question is opened. In manual officiating no foul is called, but the referee notes who
committed the last one.

Section: ours.
Measures: whether the box is connected, as the host reports it, and the time since it has gone.
Not judged: whether the box is right.
"""

from schemas.soccer.game import EventKind, OfficiatingMode, Phase
from sim_host.soccer.referee.game.refbox_presence import GRACE_S
from sim_host.soccer.referee.procedures import periods
from sim_host.soccer.referee.rules import first_decision
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.situation import Situation

RULE = "refbox"
"""The name of the rule in the events of a box."""


def with_offender(situation: Situation) -> Situation:
    """The situation with the robot that commits a foul in this tick, in manual officiating, where no foul is called."""
    state = situation.state
    if situation.match.mode is not OfficiatingMode.MANUAL or not state.running:
        return situation
    found = first_decision(situation)
    if found is None or found[1].kind is not EventKind.FOUL or found[1].robot is None:
        return situation
    return situation._replace(state=state._replace(offender=found[1].robot))


def change(draft: RulingDraft) -> None:
    """Report that a box begins to officiate or has ceased to, and set the limit of a break."""
    state = draft.state
    if state.refbox_decides:
        draft.add_event(EventKind.ACTION, RULE, "a league's referee box officiates: no rule of time ends a period")
    else:
        draft.add_event(
            EventKind.ACTION,
            RULE,
            f"the league's referee box has been gone for {GRACE_S:g} s: the rules of time apply again",
        )
    if state.phase is Phase.HALF_TIME:
        draft.state = state._replace(timing=state.timing._replace(until=periods.break_limit(draft)))
