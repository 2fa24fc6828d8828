"""Cards, and robots that leave the field and come back.

Yellow cards of one robot add up to a suspension, and then to a red card. A robot off the field stands beyond the
boundary, and its commands have no effect. Suspensions count between START and STOP, as in the league's referee box,
repairs and substitutions always. When the time is up, the robot comes back by itself at the next stoppage, at its
side's right touch line, where there is room, one of each side in a tick. A robot whose agent does not answer is taken
off the field, and comes back when the agent answers again. A robot that people have parked comes back when they request
it.

Section: misconduct; repair and substitution.
Measures: cards of each robot, red cards of each side, the time off the field, and the time for which an agent has not
answered, as the host reports it.
Not judged: whether a robot is fit to play. Cards stay with the name of a robot, also after a substitution.
"""

import dataclasses
from collections.abc import Mapping

from schemas.config.soccer.rule_book import Discipline
from schemas.side import Side
from schemas.soccer.game import RESTARTS, Card, EventKind, OffField, Phase
from sim_host.soccer.referee.game.participation import SUSPENSIONS, Absence, CardCount, Participation
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.placement.bench import bench_pose, entry_pose
from sim_host.soccer.referee.ruling_draft import RulingDraft

RULE = "discipline"
_SECOND = 2
"""Yellow cards of a robot after its second one."""
WAITS_FOR_PEOPLE = frozenset({OffField.PARKED})
"""Reasons that only a person ends: the robot comes back on request."""
STOPPAGES = RESTARTS | {Phase.STOPPED, Phase.HALF_TIME, Phase.PARKING}
"""Phases in which robots may come back, before START is given."""


def show_card(draft: RulingDraft, rule: str, name: str, card: Card, *, second: bool = False) -> None:
    """Show a robot a card, and send it off if the rule book requires it; a referee box decides that itself.

    A yellow card that is the `second` suspends the robot, whatever it was shown before.
    """
    participation, book = draft.state.participation, draft.book.discipline
    record = participation.cards.get(name, CardCount())
    absence = None
    if card is Card.YELLOW:
        record = record._replace(yellow=_SECOND if second else record.yellow + 1)
        if second:
            absence = Absence(OffField.SECOND_YELLOW, book.suspension)
        elif not draft.state.refbox_decides:
            card, absence = _after_yellow(book, record.yellow)
    if card is Card.RED:
        before = _count_reds(draft, draft.match.roster.side_of(name))
        record = CardCount(0, record.red + 1)
        absence = Absence(OffField.RED_CARD, _red_duration(book, before))
    draft.state = draft.state._replace(
        participation=dataclasses.replace(participation, cards={**participation.cards, name: record})
    )
    count = f"{record.yellow} in all" if card is Card.YELLOW else f"{record.red} in all"
    draft.add_event(
        EventKind.CARD,
        rule,
        f"{card.value} card for {name}, {count}",
        side=draft.match.roster.side_of(name),
        robot=name,
        card=card,
    )
    if absence is not None:
        take_out(draft, rule, name, absence)


def owe_card(draft: RulingDraft, rule: str, name: str, card: Card) -> None:
    """Keep a card that is shown at the next stop."""
    draft.state = draft.state._replace(participation=draft.state.participation.with_owed_card(name, rule, card))


def show_owed_cards(draft: RulingDraft) -> None:
    """Show the cards for fouls after which play went on."""
    owed = draft.state.participation.owed
    if owed:
        draft.state = draft.state._replace(participation=dataclasses.replace(draft.state.participation, owed=()))
    for name, rule, card in owed:
        show_card(draft, rule, name, card)


def take_out(draft: RulingDraft, rule: str, name: str, absence: Absence) -> None:
    """Take a robot off the field; for one that is off already, the new reason replaces the old one.

    The longer of two suspensions is served.
    """
    participation, was_there = draft.state.participation, name not in draft.state.participation.absences
    if not was_there and absence.left is not None:
        before = participation.absences[name]
        if before.left is not None and before.why in SUSPENSIONS:
            absence = absence._replace(left=max(before.left, absence.left))
    draft.state = draft.state._replace(
        participation=dataclasses.replace(participation, absences={**participation.absences, name: absence})
    )
    if was_there:
        draft.place_robot(name, bench_pose(draft.match, draft.state, name))
    draft.add_event(
        EventKind.OFF_FIELD,
        rule,
        f"{name} is off the field: {_why(absence)}",
        side=draft.match.roster.side_of(name),
        robot=name,
        limit=absence.left,
        unit="" if absence.left is None else "s",
    )


def why_stays_out(draft: RulingDraft, name: str) -> str | None:
    """Why a robot off the field may not come back now, or None."""
    state, participation = draft.state, draft.state.participation
    absence, side = participation.absences[name], draft.match.roster.side_of(name)
    if absence.for_good:
        return "it is sent off for good"
    if absence.left is not None and not reached(0.0, absence.left):
        return f"its time is not up, {absence.left:.1f} s left"
    if name in participation.silent:
        return "its agent does not answer"
    if state.phase not in STOPPAGES or state.running:
        return f"it comes back in a stoppage, the phase is {state.phase}"
    limit = draft.book.people.returns_per_stoppage
    if participation.returned.get(side, 0) >= limit:
        return f"{limit} robots of its side have come back in this stoppage, which is the limit"
    if entry_pose(draft.match, state, draft.snapshot, name) is None:
        return "there is no room at its touch line"
    return None


def bring_back(draft: RulingDraft, rule: str, name: str) -> None:
    """Bring a robot back to the field; the caller has checked `why_stays_out`."""
    state, participation = draft.state, draft.state.participation
    pose = entry_pose(draft.match, state, draft.snapshot, name)
    if pose is None:
        return
    side, why = draft.match.roster.side_of(name), participation.absences[name].why
    absences = {other: one for other, one in participation.absences.items() if other != name}
    returned = {**participation.returned, side: participation.returned.get(side, 0) + 1}
    draft.state = state._replace(participation=dataclasses.replace(participation, absences=absences, returned=returned))
    draft.place_robot(name, pose)
    draft.add_event(
        EventKind.ON_FIELD,
        rule,
        f"{name} is back on the field after: {reason_text(why)}",
        side=side,
        robot=name,
        place=(pose.x, pose.y),
    )


def advance(draft: RulingDraft) -> None:
    """Apply the effects of time: robots with a silent agent are taken off, those whose time is up come back."""
    participation, limit = draft.state.participation, draft.book.people.silent_limit
    if participation.silent and limit and draft.state.phase not in (Phase.PRE_GAME, Phase.FULL_TIME):
        for name in draft.match.roster.names:
            if (
                name in participation.silent
                and name not in participation.absences
                and reached(participation.silent[name], limit)
            ):
                take_out(draft, RULE, name, Absence(OffField.SILENT))
    if not draft.state.participation.absences or draft.state.running:
        return
    arrived: set[Side] = set()  # one in a tick: the next snapshot shows where it is, and where there is room
    for name, side in zip(draft.match.roster.names, draft.match.roster.sides, strict=True):
        absence = draft.state.participation.absences.get(name)
        if absence is None or absence.why in WAITS_FOR_PEOPLE or side in arrived:
            continue
        if why_stays_out(draft, name) is None:
            bring_back(draft, RULE, name)
            arrived.add(side)


def for_next_half(participation: Participation, book: Discipline) -> Participation:
    """The participation at the start of the next half: cards and repeated fouls are reset if the rule book says so."""
    if not book.reset_each_half:
        return participation
    cards = {name: record._replace(yellow=0) for name, record in participation.cards.items()}
    return dataclasses.replace(participation, cards=cards, offences={})


def for_new_stoppage(participation: Participation) -> Participation:
    """The participation at STOP: no robot has come back yet."""
    return dataclasses.replace(participation, returned={}) if participation.returned else participation


def count_playable(draft: RulingDraft, side: Side) -> int:
    """Number of robots of a side that are on the field or may come back to it."""
    participation, roster = draft.state.participation, draft.match.roster
    mine = [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side]
    gone = [name for name in mine if name in participation.absences and _is_gone(participation.absences[name])]
    return len(mine) - len(gone)


def reason_text(why: OffField) -> str:
    """A reason as people read it."""
    return REASONS[why]


REASONS: Mapping[OffField, str] = {
    OffField.SECOND_YELLOW: "suspension",
    OffField.RED_CARD: "red card",
    OffField.REPAIR: "repair",
    OffField.SUBSTITUTION: "substitution",
    OffField.SILENT: "its agent does not answer",
    OffField.PARKED: "parked",
}


def _after_yellow(book: Discipline, yellows: int) -> tuple[Card, Absence | None]:
    """The card that the last of these yellow cards becomes, and the suspension that follows from it."""
    if book.yellows_to_red and yellows >= book.yellows_to_red:
        return Card.RED, None
    suspends = book.yellows_to_suspension and yellows == book.yellows_to_suspension
    return Card.YELLOW, Absence(OffField.SECOND_YELLOW, book.suspension) if suspends else None


def _is_gone(absence: Absence) -> bool:
    return absence.for_good or absence.why is OffField.SILENT


def _why(absence: Absence) -> str:
    reason = reason_text(absence.why)
    if absence.left is not None:
        return f"{reason}, {absence.left:g} s"
    return f"{reason}, for good" if absence.for_good else reason


def _count_reds(draft: RulingDraft, side: Side) -> int:
    """Number of red cards that robots of a side have been shown."""
    cards, roster = draft.state.participation.cards, draft.match.roster
    return sum(record.red for name, record in cards.items() if name in roster.names and roster.side_of(name) is side)


def _red_duration(book: Discipline, before: int) -> float | None:
    """s off the field for a red card of a side with `before` earlier ones; None if it is for good."""
    if not book.red_duration or (book.reds_to_removal and (before + 1) % book.reds_to_removal == 0):
        return None
    return book.red_duration + before * book.red_growth
