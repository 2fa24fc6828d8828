"""Every figure of `touchline stats` as one flat row of numbers."""

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any

from recordings.soccer.stats.figures import KickCounts, MatchFigures
from schemas.side import Side

Value = float | int | None
"""A figure; None where the match does not show it."""

FIRST, SECOND = "first", "second"
"""Prefixes of the columns of the first team, which is in cyan unless sides are swapped, and of the second."""

DIFFERENCE = ".difference"
"""End of the name of a response that compares the two teams; without an effect it is 0."""

_MATCH = ("duration", "in_play_s", "in_play", "free_s", "crowded_s", "longest_crowd_s", "drop_balls")
_COUNTED = ("fouls", "cards", "restarts")
"""Figures that are counted by name: rule, card, phase."""
_RENAMED = {"kicks.goals": "goals_from_shots", "kicks.kicks": "kicks"}
_NO_KICKS = dict.fromkeys(field.name for field in fields(KickCounts))
"""Figures of kicks of a match in which nobody touched the ball."""
_NOT_SUMMED = ("top_speed", "mean_speed", "possession", "result")
"""Figures of a team whose sum over both teams means nothing."""


def flat_figures(figures: MatchFigures) -> dict[str, Value]:
    """The figures of a match by name; cyan's as `cyan.NAME`, of its first robot as `cyan.1.NAME`."""
    content = figures.to_json()
    flat: dict[str, Value] = {name: content[name] for name in _MATCH}
    for side in Side:
        team = content["sides"][side.value]
        flat |= {f"{side}.{name}": value for name, value in _numbers(team)}
        flat |= {f"{side}.{name}": sum(team[name].values()) for name in _COUNTED}
        robots = [robot for robot in content["robots"] if robot["side"] == side.value]
        for number, robot in enumerate(robots, start=1):
            flat |= {f"{side}.{number}.{name}": value for name, value in _numbers(robot)}
    return flat


def by_team(flat: Mapping[str, Value], sides: tuple[Side, Side]) -> dict[str, Value]:
    """The row with the first and the second team in place of sides, and sums and differences of both teams.

    `goals` is the sum, `goals.difference` is the first team's less the second's. `first.result` is 1 for a win,
    0.5 for a draw.
    """
    sided = {name: value for name, value in flat.items() if name.partition(".")[0] in (*Side,)}
    row = {name: value for name, value in flat.items() if name not in sided}
    for team, side in zip((FIRST, SECOND), sides, strict=True):
        own = {name.partition(".")[2]: value for name, value in sided.items() if name.startswith(f"{side}.")}
        row |= {f"{team}.{name}": value for name, value in own.items()}
    row |= _result(row)
    for name in [one.removeprefix(f"{FIRST}.") for one in row if one.startswith(f"{FIRST}.") and one.count(".") == 1]:
        first, second = row[f"{FIRST}.{name}"], row.get(f"{SECOND}.{name}")
        known = first is not None and second is not None
        # figures have six digits after the point
        row[f"{name}{DIFFERENCE}"] = round(first - second, 6) if known else None  # type: ignore[operator]
        if name not in _NOT_SUMMED:
            row[name] = round(first + second, 6) if known else None  # type: ignore[operator]
    return row


def _result(row: Mapping[str, Value]) -> dict[str, Value]:
    first, second = row.get(f"{FIRST}.goals"), row.get(f"{SECOND}.goals")
    if first is None or second is None:
        return {f"{FIRST}.result": None, f"{SECOND}.result": None}
    result = 0.5 + 0.5 * ((first > second) - (first < second))
    return {f"{FIRST}.result": result, f"{SECOND}.result": 1 - result}


def _numbers(content: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Value]]:
    for name, known in content.items():
        full = f"{prefix}{name}"
        value = _NO_KICKS if full == "kicks" and known is None else known
        if isinstance(value, dict):
            yield from _numbers(value, f"{name}.")
        elif value is None or (isinstance(value, int | float) and not isinstance(value, bool)):
            yield _RENAMED.get(full, full.removeprefix("kicks.")), value
