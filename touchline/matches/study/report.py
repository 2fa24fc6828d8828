"""The report of a study: one HTML file that opens from disk, with plots, intervals and sentences."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from touchline.matches.engine.outcome import Failed
from touchline.matches.report import page_of
from touchline.matches.statistics.paired import estimate_of, seed_means, widest
from touchline.matches.study.comparisons import ComparisonGroup, answers, compared, unread_factors
from touchline.matches.study.digests import as_text
from touchline.matches.study.plots import plot_of_comparisons, plot_of_means
from touchline.matches.study.sentences import (
    UNKNOWN,
    number,
    response_text,
    sentence_of,
    sentence_of_missing,
    sentence_of_unread,
)
from touchline.matches.study.study_plan import StudyPlan


def report_of(
    plan: StudyPlan, table: pd.DataFrame, seeds: Sequence[int], failed: Sequence[Failed], versions: Mapping[str, object]
) -> str:
    """The report as one page."""
    study, groups = plan.study, compared(plan, table)
    return page_of(
        "study/report.html",
        title=study.title or study.name,
        study=study,
        matches=len(table),
        cells=len(plan.cells),
        seeds=len(seeds),
        interval=_interval_text(plan, table),
        failed=failed,
        missing=[sentence_of_missing(name, list(table)) for name in study.responses if name not in table],
        unread=map(sentence_of_unread, unread_factors(plan, table)),
        answers=[(one.is_found, sentence_of(one, name)) for name in groups for one in answers(groups[name])],
        responses=[_response(plan, table, name, groups[name]) for name in groups],
        versions=as_text(versions),
    )


def _response(plan: StudyPlan, table: pd.DataFrame, response: str, groups: Sequence[ComparisonGroup]) -> dict[str, Any]:
    """Plots and rows of the tables of a response."""
    means = seed_means(table, response, plan.study.matches_of_seed)
    plots = [("Means of the cells", plot_of_means(means, plan.cells, response))]
    plots += [(group.title, plot_of_comparisons(group.comparisons, response)) for group in groups]
    cells = (
        (cell.label, estimate_of(means[place])) for place, cell in enumerate(plan.cells, start=1) if place in means
    )
    return {
        "name": response_text(response),
        "plots": plots,
        "means": [(label, number(one.value), _interval(one.low, one.high), one.seeds) for label, one in cells],
        "differences": [
            (
                f"{one.label} – {one.reference}",
                number(one.estimate.value),
                _interval(one.estimate.low, one.estimate.high),
                number(one.effect_size),
                number(one.p),
                number(one.adjusted_p),
                one.estimate.seeds,
            )
            for group in groups
            for one in group.comparisons
        ],
    }


def _interval_text(plan: StudyPlan, table: pd.DataFrame) -> str:
    study = plan.study
    limit, width = study.until_interval, widest(table, study.primary, study.matches_of_seed)
    if limit is None:
        return ""
    reached = width is not None and width <= limit
    wanted = f"Played until the interval of {response_text(study.primary)} is at most {limit:g} wide: "
    return wanted + (f"it is {number(width)}." if reached else f"not reached; it is {number(width)}.")


def _interval(low: float | None, high: float | None) -> str:
    return UNKNOWN if low is None else f"{number(low)} to {number(high)}"
