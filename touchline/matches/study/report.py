"""The report of a study: one HTML file that opens from disk, with plots, intervals and sentences."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib import resources

import pandas as pd

from touchline.matches.engine.outcome import Failed
from touchline.matches.study.analysis import Comparison, adjusted, estimate_of, seed_means, widest
from touchline.matches.study.comparisons import ComparisonGroup, answers, comparison_groups
from touchline.matches.study.digests import as_text
from touchline.matches.study.plots import plot_of_comparisons, plot_of_means
from touchline.matches.study.sentences import UNKNOWN, number, response_text, sentence_of
from touchline.matches.study.study_plan import StudyPlan

_READING = (
    "Points are means over seeds, bars are intervals of 95 % by Student's t, small dots are single seeds. Every cell "
    "has the same seeds, so cells are compared seed by seed: an interval of a paired difference that leaves 0 out "
    "(magenta) shows an effect, even where the bars of the means overlap. The effect size is the mean difference "
    "divided by the standard deviation of the seeds' differences (Cohen's d_z). Of 20 comparisons without any effect, "
    "one interval leaves 0 out by chance; the adjusted p (Benjamini and Hochberg, over all comparisons of this page) "
    "accounts for that."
)


def report_of(
    plan: StudyPlan,
    table: pd.DataFrame,
    seeds: Sequence[int],
    failed: Sequence[Failed],
    versions: Mapping[str, object],
) -> str:
    """The report as one page."""
    study = plan.study
    responses = [name for name in (*study.responses, *study.functions) if name in table]
    missing = [name for name in study.responses if name not in table]
    groups = {name: comparison_groups(plan, table, name) for name in responses}
    compared = [one for each in groups.values() for group in each for one in group.comparisons]
    p_values = dict(zip(map(id, compared), adjusted(compared), strict=True))
    sides = ", each on both sides" if study.both_sides else ""
    parts = [
        f"<h1>{escape(study.title or study.name)}</h1>",
        f"<p>{escape(study.question)}</p>" if study.question else "",
        f'<p class="quiet">{len(table)} matches: {_cells(plan)}{len(seeds)} seeds{sides}. '
        f"{_interval_text(plan, table)}</p>",
        _failures(failed),
        *(
            _paragraph(f"No match has a figure {name}; the columns of the table of results are its names.")
            for name in missing
        ),
        _answers(plan, table, responses),
        *(_section(plan, table, name, groups[name], p_values) for name in responses),
        f'<section><h2>How to read this page</h2><p class="quiet">{escape(_READING)}</p></section>',
        f"<section><h2>Versions</h2><pre>{escape(as_text(versions))}</pre></section>",
    ]
    style = (resources.files("touchline.matches.study") / "report.css").read_text("utf-8")
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(study.title or study.name)}</title><style>{style}</style></head><body>\n"
        + "\n".join(part for part in parts if part)
        + "\n<footer>Made by <code>touchline experiment</code>; all figures of all matches are in "
        '<a href="results.csv">results.csv</a> and <a href="results.parquet">results.parquet</a>.</footer>\n'
        "</body></html>\n"
    )


def _answers(plan: StudyPlan, table: pd.DataFrame, responses: Sequence[str]) -> str:
    """The sentences of all responses."""
    compared = [(response, one) for response in responses for one in answers(plan, table, response)]
    items = [f"<li{_class(one)}>{escape(sentence_of(one, response))}</li>" for response, one in compared]
    return f'<section><h2>Answers</h2><ul class="answers">{"".join(items)}</ul></section>' if items else ""


def _section(
    plan: StudyPlan,
    table: pd.DataFrame,
    response: str,
    groups: Sequence[ComparisonGroup],
    p_values: Mapping[int, float | None],
) -> str:
    means = seed_means(table, response, plan.study)
    name = response_text(response)
    plots = [("Means of the cells", plot_of_means(means, plan.cells, response))]
    plots += [(group.title, plot_of_comparisons(group.comparisons, response)) for group in groups]
    figures = "".join(f"<figure>{svg}<figcaption>{escape(text)}</figcaption></figure>" for text, svg in plots)
    cells = (
        (cell.label, estimate_of(means[place])) for place, cell in enumerate(plan.cells, start=1) if place in means
    )
    mean_rows = [(label, number(one.value), _interval(one.low, one.high), str(one.seeds)) for label, one in cells]
    rows = [
        (
            f"{one.label} – {one.reference}",
            number(one.estimate.value),
            _interval(one.estimate.low, one.estimate.high),
            number(one.effect_size),
            number(one.p),
            number(p_values[id(one)]),
            str(one.estimate.seeds),
        )
        for group in groups
        for one in group.comparisons
    ]
    tables = _table(("cell", "mean", "95 % interval", "seeds"), mean_rows)
    if rows:
        headings = ("difference", "value", "95 % interval", "effect size", "p", "adjusted p", "seeds")
        tables += _table(headings, rows)
    return f'<section><h2>{escape(name)}</h2><div class="plots">{figures}</div>{tables}</section>'


def _cells(plan: StudyPlan) -> str:
    return f"{len(plan.cells)} cells × " if len(plan.cells) > 1 else ""


def _interval_text(plan: StudyPlan, table: pd.DataFrame) -> str:
    limit, width = plan.study.until_interval, widest(table, plan.study)
    if limit is None:
        return ""
    reached = width is not None and width <= limit
    wanted = f"Played until the interval of {response_text(plan.study.primary)} is at most {limit:g} wide: "
    return escape(wanted + (f"it is {number(width)}." if reached else f"not reached; it is {number(width)}."))


def _failures(failed: Sequence[Failed]) -> str:
    if not failed:
        return ""
    reasons = dict.fromkeys(one.reason for one in failed)
    items = "".join(f"<li>{escape(reason)}</li>" for reason in reasons)
    return f"<section><h2>{len(failed)} matches failed and are in no figure</h2><ul>{items}</ul></section>"


def _table(headings: Iterable[str], rows: Iterable[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(one)}</th>" for one in headings)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def _interval(low: float | None, high: float | None) -> str:
    return UNKNOWN if low is None else f"{number(low)} to {number(high)}"


def _paragraph(text: str) -> str:
    return f"<p>{escape(text)}</p>"


def _class(comparison: Comparison) -> str:
    return ' class="found"' if comparison.estimate.contains_zero is False else ""
