"""Cards and people: who is shown what, who leaves the field and for how long, and who comes back when.

Yellow cards of one robot add up to a suspension and then to a red card. A robot off the field stands beyond the
boundary, and its commands rest. Suspensions are served in playing time, repairs and substitutions also while the clock
stands; then the robot comes back by itself at the next stoppage, at its side's right touch line, where there is room. A
robot whose program is gone is taken out, and comes back when it is heard again; one that people parked, when they say.

Section: misconduct; repair and substitution.
Measures: cards by robot, red cards by side, the time off; how long a program has not answered, as the host tells it.
Not judged: who is fit to play; cards stay with the name, also of a substitute.
"""

import dataclasses
from collections.abc import Mapping

from schemas.game import RESTARTS, Card, EventKind, OffField, Phase
from schemas.rule_book import Discipline
from schemas.side import Side
from sim_host.referee.bench import bench_pose, entry_pose
from sim_host.referee.people import Away, People, Record
from sim_host.referee.timing import reached
from sim_host.referee.turn import Turn

RULE = "discipline"
WAITS_FOR_PEOPLE = frozenset({OffField.PARKED})
"""Robots that come back only when somebody asks for it."""
STOPPAGES = RESTARTS | {Phase.STOPPED, Phase.HALF_TIME, Phase.PARKING}
"""Phases in which robots may come back, before START is given."""


def show(turn: Turn, rule: str, name: str, card: Card) -> None:
    """Show a robot a card, and send it off when the rule book says so."""
    people, book = turn.state.people, turn.book.discipline
    record = people.records.get(name, Record())
    away = None
    if card is Card.YELLOW:
        record = record._replace(yellow=record.yellow + 1)
        if book.yellows_to_red and record.yellow >= book.yellows_to_red:
            card = Card.RED
        elif book.yellows_to_suspension and record.yellow == book.yellows_to_suspension:
            away = Away(OffField.SECOND_YELLOW, book.suspension)
    if card is Card.RED:
        before = _reds(turn, turn.match.roster.side_of(name))
        record = Record(0, record.red + 1)
        away = Away(OffField.RED_CARD, _red_duration(book, before))
    turn.state = turn.state._replace(people=dataclasses.replace(people, records={**people.records, name: record}))
    count = f"{record.yellow} in all" if card is Card.YELLOW else f"{record.red} in all"
    turn.say(
        EventKind.CARD,
        rule,
        f"{card.value} card for {name}, {count}",
        side=turn.match.roster.side_of(name),
        robot=name,
        card=card,
    )
    if away is not None:
        take_out(turn, rule, name, away)


def take_out(turn: Turn, rule: str, name: str, away: Away) -> None:
    """Have a robot leave the field; one that has left already is off for the new reason from now on."""
    people, was_there = turn.state.people, name not in turn.state.people.away
    turn.state = turn.state._replace(people=dataclasses.replace(people, away={**people.away, name: away}))
    if was_there:
        turn.place_robot(name, bench_pose(turn.match, turn.state, name))
    turn.say(
        EventKind.OFF_FIELD,
        rule,
        f"{name} is off the field: {_why(away)}",
        side=turn.match.roster.side_of(name),
        robot=name,
        limit=away.left,
        unit="" if away.left is None else "s",
    )


def why_stays_out(turn: Turn, name: str) -> str | None:
    """Why a robot off the field may not come back now, or nothing."""
    state, people = turn.state, turn.state.people
    away, side = people.away[name], turn.match.roster.side_of(name)
    if away.for_good:
        return "it is sent off for good"
    if away.left is not None and not reached(0.0, away.left):
        return f"its time is not up, {away.left:.1f} s are left"
    if name in people.silent:
        return "its program does not answer"
    if state.phase not in STOPPAGES or state.running:
        return f"it comes back in a stoppage, the phase is {state.phase}"
    limit = turn.book.people.returns_per_stoppage
    if people.returned.get(side, 0) >= limit:
        return f"{limit} of its side came back in this stoppage already, which is the limit"
    if entry_pose(turn.match, state, turn.snapshot, name) is None:
        return "there is no room at its touch line"
    return None


def bring_back(turn: Turn, rule: str, name: str) -> None:
    """Have a robot come back, where there is room; `why_stays_out` has been asked."""
    state, people = turn.state, turn.state.people
    pose = entry_pose(turn.match, state, turn.snapshot, name)
    if pose is None:
        return
    side, why = turn.match.roster.side_of(name), people.away[name].why
    away = {other: one for other, one in people.away.items() if other != name}
    returned = {**people.returned, side: people.returned.get(side, 0) + 1}
    turn.state = state._replace(people=dataclasses.replace(people, away=away, returned=returned))
    turn.place_robot(name, pose)
    turn.say(
        EventKind.ON_FIELD,
        rule,
        f"{name} is back on the field after: {spoken_reason(why)}",
        side=side,
        robot=name,
        place=(pose.x, pose.y),
    )


def progress(turn: Turn) -> None:
    """What time brings: robots whose program is gone are taken out, those whose time is up come back."""
    people, limit = turn.state.people, turn.book.people.silent_limit
    if people.silent and limit and turn.state.phase not in (Phase.PRE_GAME, Phase.FULL_TIME):
        for name in turn.match.roster.names:
            if name in people.silent and name not in people.away and reached(people.silent[name], limit):
                take_out(turn, RULE, name, Away(OffField.SILENT))
    if not turn.state.people.away or turn.state.running:
        return
    arrived = False
    for name in turn.match.roster.names:
        away = turn.state.people.away.get(name)
        if away is None or away.why in WAITS_FOR_PEOPLE or arrived:
            continue
        if why_stays_out(turn, name) is None:
            bring_back(turn, RULE, name)
            arrived = True  # the next looks for room in the next tick, when this one is seen where it came


def forgotten(people: People, book: Discipline) -> People:
    """The people of the next half: yellow cards are forgotten where the rule book says so."""
    if not book.reset_each_half:
        return people
    records = {name: record._replace(yellow=0) for name, record in people.records.items()}
    return dataclasses.replace(people, records=records)


def new_stoppage(people: People) -> People:
    """The people at STOP: nobody has come back yet."""
    return dataclasses.replace(people, returned={}) if people.returned else people


def can_play(turn: Turn, side: Side) -> int:
    """How many robots a side has that are on the field or may come back to it."""
    people, roster = turn.state.people, turn.match.roster
    mine = [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side]
    gone = [name for name in mine if name in people.away and _is_gone(people.away[name])]
    return len(mine) - len(gone)


def spoken_reason(why: OffField) -> str:
    """A reason in words."""
    return REASONS[why]


REASONS: Mapping[OffField, str] = {
    OffField.SECOND_YELLOW: "suspension",
    OffField.RED_CARD: "red card",
    OffField.REPAIR: "repair",
    OffField.SUBSTITUTION: "substitution",
    OffField.SILENT: "its program is gone",
    OffField.PARKED: "parked",
}


def _is_gone(away: Away) -> bool:
    return away.for_good or away.why is OffField.SILENT


def _why(away: Away) -> str:
    words = spoken_reason(away.why)
    if away.left is not None:
        return f"{words}, {away.left:g} s"
    return f"{words}, for good" if away.for_good else words


def _reds(turn: Turn, side: Side) -> int:
    """Red cards that robots of a side have been shown."""
    records, roster = turn.state.people.records, turn.match.roster
    return sum(record.red for name, record in records.items() if name in roster.names and roster.side_of(name) is side)


def _red_duration(book: Discipline, before: int) -> float | None:
    """s off the field for a red card of a side that had so many before; nothing when it is for good."""
    if not book.red_duration or (book.reds_to_removal and (before + 1) % book.reds_to_removal == 0):
        return None
    return book.red_duration + before * book.red_growth
