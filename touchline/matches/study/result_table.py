"""The results of a study as a table: one row a match."""

from collections.abc import Mapping, Sequence

import pandas as pd

from schemas.side import Side
from touchline.matches.engine.outcome import Outcome, Played
from touchline.matches.series.plan import SeedMatch
from touchline.matches.study.cells import Cell, level_text
from touchline.matches.study.match_figures import Value, by_team, flat_figures

KEYS = ("cell", "seed", "swapped", "identity", "chain")
"""Columns before the levels of the factors."""
LEVEL = "level:"
"""Prefix of the columns of the factors' levels."""
COUNTS = (".fouls.", ".cards.", ".restarts.")
"""Parts of names of columns in which a missing value is 0: nothing of that name was counted in the match."""


def result_table(
    matches: Sequence[SeedMatch],
    cells: Sequence[Cell],
    outcomes: Mapping[str, Outcome],
    measured: Mapping[str, Mapping[str, Value]],
) -> pd.DataFrame:
    """Those of the matches that were played, in their order. Cells are counted from 1.

    `measured` has the values of a study's own functions, by the identity of a match.
    """
    rows = []
    for match in matches:
        outcome = outcomes.get(match.identity)
        if not isinstance(outcome, Played):
            continue
        keys = (match.cell + 1, match.seed, match.swapped, match.identity, outcome.chain)
        levels = cells[match.cell].levels
        rows.append(
            dict(zip(KEYS, keys, strict=True))
            | {
                f"{LEVEL}{key}": level if isinstance(level, bool | int | float) else level_text(level)
                for key, level in levels.items()
            }
            | _figures(outcome, match.sides)
            | dict(measured.get(match.identity, {}))
        )
    table = pd.DataFrame(rows, columns=None if rows else list(KEYS))
    leading = [name for name in table.columns if name in KEYS or name.startswith(LEVEL)]
    table = table[[*leading, *sorted(name for name in table.columns if name not in leading)]]
    for name in table.columns:
        if name.startswith(LEVEL) and table[name].map(type).nunique() > 1:
            table[name] = table[name].map(level_text)  # a column has one type
        elif any(part in name for part in COUNTS):
            table[name] = table[name].fillna(0)
    return table


def _figures(played: Played, sides: tuple[Side, Side]) -> dict[str, Value]:
    """All figures of a match by name: of soccer, or simulated time in s of a free game, and the score of a task."""
    if played.figures is None:
        return {"score": played.value, "duration": played.playing_time}
    scored = {} if played.value is None else {"score": played.value}
    return by_team(flat_figures(played.figures), sides) | scored
