"""The result of a cup: as one object for programs, as tables for people."""

from dataclasses import asdict
from typing import Any

from touchline.launch.terminal.aligned import aligned
from touchline.matches.cup.cup_state import CupMatch, CupState
from touchline.matches.cup.match_result import score_text, scored
from touchline.matches.cup.site import signed
from touchline.matches.statistics.ratings import rate

RESULT = "result.json"
"""The file of tables, matches, ratings and winner, in the folder of a cup."""


def report_of(state: CupState) -> dict[str, Any]:
    """Tables, matches, ratings and winner."""
    rated = rate(state.cup.names, scored(state.results))
    return {
        "name": state.cup.name,
        "complete": state.is_complete,
        "winner": state.winner,
        "refused": sorted(state.refused),
        "tables": {stage: [asdict(row) for row in rows] for stage, rows in state.schedule.tables.items()},
        "matches": [_match(one) for one in state.matches],
        "ratings": [asdict(one) for one in rated.teams],
        "order": [asdict(one) for one in rated.order],
        "order_is_significant": rated.significant,
    }


def report_text(state: CupState) -> str:
    """Tables, the knock-out, matches without a result, ratings and winner."""
    lines: list[str] = []
    for stage, rows in state.schedule.tables.items():
        cells = [
            (
                *map(str, (row.place, row.team, row.played, row.won, row.drawn, row.lost)),
                f"{row.goals_for}:{row.goals_against}",
                str(row.points),
            )
            for row in rows
        ]
        lines += [stage, *aligned([("", "team", "P", "W", "D", "L", "goals", "points"), *cells]), ""]
    bracket = state.schedule.bracket
    if bracket is not None:
        names = {one.name for one in bracket.fixtures}
        played = [one for one in state.matches if one.slot.fixture.name in names and one.result is not None]
        lines += [match_line(one) for one in played]
        lines += [f"{name} is level, and decided by {criterion}" for name, criterion in bracket.decided_by.items()]
        lines.append("")
    for one in state.matches:
        if one.ended is not None and one.ended.reason is not None:
            lines.append(f"{one.slot.name} {one.state}: {one.ended.reason}")
    rated = rate(state.cup.names, scored(state.results))
    cells = [(one.team, signed(one.value), f"{signed(one.low)} to {signed(one.high)}") for one in rated.teams]
    sentence = "the order is significant" if rated.significant else "the order is not significant"
    lines += [*aligned([("", "rating", "interval of 95 %"), *cells]), sentence, ""]
    nobody = "no team was admitted" if state.is_complete else "the cup is not complete"
    lines.append(f"winner  {state.winner}" if state.winner is not None else nobody)
    return "\n".join(lines)


def match_line(one: CupMatch) -> str:
    """A match that is over: its name, the teams, and the score."""
    cyan, magenta = one.slot.sides
    return f"{one.slot.name}: {cyan} {score_text(one.result, cyan) if one.result is not None else 'failed'} {magenta}"


def _match(one: CupMatch) -> dict[str, Any]:
    cyan, magenta = one.slot.sides
    ended = asdict(one.ended) if one.ended is not None else {}
    return {"match": one.slot.name, "cyan": cyan, "magenta": magenta, "state": one.state.value} | ended
