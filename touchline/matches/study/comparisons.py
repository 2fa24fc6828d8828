"""Which comparisons a study makes of a response: levels of factors, cells, and the two teams."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import pandas as pd

from touchline.matches.series.plan import team_names
from touchline.matches.statistics.paired import Comparison, adjusted, comparison_of, seed_means
from touchline.matches.study.cells import level_text
from touchline.matches.study.match_figures import DIFFERENCE
from touchline.matches.study.study_plan import StudyPlan


@dataclass(frozen=True, slots=True)
class ComparisonGroup:
    """Comparisons that belong together: one plot of a report."""

    title: str
    comparisons: list[Comparison]
    is_answer: bool
    """Whether they answer the question of the study; the others are details."""


def compared(plan: StudyPlan, table: pd.DataFrame) -> dict[str, list[ComparisonGroup]]:
    """Response → its comparisons, for all that the table has; p is adjusted for all of these together."""
    names = [name for name in (*plan.study.responses, *plan.study.functions) if name in table]
    groups = {name: comparison_groups(plan, table, name) for name in names}
    each = iter(adjusted([one for of_name in groups.values() for group in of_name for one in group.comparisons]))
    return {
        name: [replace(group, comparisons=list(islice(each, len(group.comparisons)))) for group in of_name]
        for name, of_name in groups.items()
    }


def unread_factors(plan: StudyPlan, table: pd.DataFrame) -> list[str]:
    """Keys that change nothing: matches that differ in the level alone are the same match, by their hash chains."""
    found = []
    for key in plan.cells[0].levels:
        chains: dict[str, list[str]] = {}
        for row in table.itertuples():
            levels = {**plan.cells[int(row.cell) - 1].levels, key: None}
            chains.setdefault(f"{levels} {row.seed} {row.swapped}", []).append(row.chain)
        compared = [same for same in chains.values() if len(same) > 1]
        if compared and all(len(set(same)) == 1 for same in compared):
            found.append(key)
    return found


def comparison_groups(plan: StudyPlan, table: pd.DataFrame, response: str) -> list[ComparisonGroup]:
    """All comparisons of a response; groups without one are left out."""
    means = seed_means(table, response, plan.study.matches_of_seed)
    effects = list(_main_effects(plan, means))
    cells = _cells_with_first(plan, means)
    title = f"Cells, against {cells[0].reference}" if cells else ""
    groups = [*effects, ComparisonGroup(title, cells, is_answer=not effects)]
    if response.endswith(DIFFERENCE):
        teams = _teams(plan, means)
        groups.append(ComparisonGroup("First team against second", teams, is_answer=len(plan.cells) == 1))
    return [group for group in groups if group.comparisons]


def answers(groups: Sequence[ComparisonGroup]) -> list[Comparison]:
    """The comparisons of a response that answer the question of the study."""
    return [one for group in groups if group.is_answer for one in group.comparisons]


def _cells_with_first(plan: StudyPlan, means: pd.DataFrame) -> list[Comparison]:
    """Each cell against the first one that was played."""
    first, *others = map(int, means.columns)
    labels = [cell.label for cell in plan.cells]
    return [
        comparison_of(means[cell] - means[first], labels[cell - 1], labels[first - 1], 2 * plan.study.matches_of_seed)
        for cell in others
    ]


def _teams(plan: StudyPlan, means: pd.DataFrame) -> list[Comparison]:
    """The first team against the second in each cell."""
    found = []
    for number in map(int, means.columns):
        cell = plan.cells[number - 1]
        first, second = team_names(cell.config)
        where = f" ({cell.label})" if cell.levels else ""
        found.append(comparison_of(means[number], first, f"{second}{where}", plan.study.matches_of_seed))
    return found


def _main_effects(plan: StudyPlan, means: pd.DataFrame) -> Iterator[ComparisonGroup]:
    """Each level of a factor against the first one, averaged over all other factors; for two factors or more."""
    if len(plan.study.factors) < 2:
        return
    for key, (baseline, *others) in plan.study.factors.items():
        averages = {
            level_text(level): means.reindex(
                columns=[number for number, cell in enumerate(plan.cells, start=1) if cell.levels[key] == level]
            ).mean(axis=1, skipna=False)
            for level in (baseline, *others)
        }
        first = level_text(baseline)
        matches = 2 * plan.study.matches_of_seed * len(plan.cells) // (1 + len(others))
        compared = [
            comparison_of(averages[name] - averages[first], f"{key} = {name}", f"{key} = {first}", matches)
            for name in map(level_text, others)
        ]
        yield ComparisonGroup(f"{key}, averaged over all other factors", compared, is_answer=True)
