"""The plots of a report, as SVG to be placed in a page."""

import io
import logging
import re
import textwrap
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from touchline.matches.statistics.estimates import Estimate
from touchline.matches.statistics.paired import Comparison, estimate_of
from touchline.matches.study.cells import Cell, level_text
from touchline.matches.study.match_figures import DIFFERENCE
from touchline.matches.study.sentences import response_text

logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)  # it says that it builds a cache of fonts

_SIZE = (4.2, 3.0)
"""Width and height in inches: small, so that the texts can be read where a phone scales the plot down."""
_LABEL_WIDTH = 26
"""Most letters in a line of an axis label."""
_STYLE: Any = {
    "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 11, "axes.axisbelow": True,
    "text.parse_math": False,  # a team may be called $
}  # fmt: skip
_COLOURS = ("#0b6e75", "#b3306e", "#7a5c00", "#3b4cc0", "#5b7f2a", "#8a4b2f")
_MARKERS = "osD^vP"


def plot_of_means(means: pd.DataFrame, cells: Sequence[Cell], response: str) -> str:
    """The mean of each cell with its interval: the last factor on the axis, a line for each combination of the others.

    Small dots are seeds.
    """
    *others, axis = list(cells[0].levels) or ["matches"]
    levels = list(dict.fromkeys(level_text(cell.levels.get(axis, "all")) for cell in cells))
    lines = dict[str, list[int]]()
    for number, cell in enumerate(cells, start=1):
        lines.setdefault(", ".join(f"{key} = {level_text(cell.levels[key])}" for key in others), []).append(number)
    with mpl.rc_context({**_STYLE, "svg.hashsalt": response}):
        figure, axes = _figure()
        for place, (label, numbers) in enumerate(lines.items()):
            shift = 0.12 * (place - (len(lines) - 1) / 2)
            shown = [number for number in numbers if number in means]
            at = [levels.index(level_text(cells[number - 1].levels.get(axis, "all"))) + shift for number in shown]
            colour = _COLOURS[place % len(_COLOURS)]
            for x, number in zip(at, shown, strict=True):
                seeds = means[number].dropna()
                axes.plot([x + 0.05] * len(seeds), seeds, ".", color=colour, alpha=0.25, markersize=4)
            _draw(axes, at, [estimate_of(means[number]) for number in shown], colour, _MARKERS[place % 6], label)
        width = max(8, 36 // len(levels))
        axes.set_xticks(range(len(levels)), [textwrap.fill(level, width) for level in levels])
        axes.set_xlim(-0.5, len(levels) - 0.5)
        axes.set_xlabel(axis)
        axes.set_ylabel(textwrap.fill(response_text(response), _LABEL_WIDTH))
        if response.endswith(DIFFERENCE):
            axes.axhline(0, color="#666", linewidth=0.8)
        if any(lines):
            axes.legend(fontsize=9, frameon=False, loc="lower left", bbox_to_anchor=(0, 1), ncols=2)  # above all points
        return _svg(figure)


def plot_of_comparisons(comparisons: Sequence[Comparison], response: str) -> str:
    """Differences with their intervals, one below the other, and the line of no difference."""
    with mpl.rc_context({**_STYLE, "svg.hashsalt": f"{response} differences"}):
        figure, axes = _figure(height=1.2 + 0.2 * sum(_wrapped(one).count("\n") + 1.4 for one in comparisons))
        axes.axvline(0, color="#666", linewidth=0.8)
        for place, one in enumerate(reversed(comparisons)):
            estimate = one.estimate
            colour = _COLOURS[1] if one.is_found else _COLOURS[0]
            if estimate.low is not None and estimate.high is not None:
                axes.plot([estimate.low, estimate.high], [place, place], color=colour, linewidth=2)
            axes.plot([estimate.value], [place], "o", color=colour, markersize=6)
        axes.set_yticks(range(len(comparisons)), [_wrapped(one) for one in reversed(comparisons)], fontsize=9)
        axes.set_ylim(-0.6, len(comparisons) - 0.4)
        axes.set_xlabel(textwrap.fill(response_text(response), 2 * _LABEL_WIDTH))
        return _svg(figure)


def _draw(axes: Axes, at: Sequence[float], estimates: Sequence[Estimate], colour: str, marker: str, label: str) -> None:
    values = [one.value for one in estimates]
    low = [one.value - one.low if one.low is not None else 0.0 for one in estimates]
    high = [one.high - one.value if one.high is not None else 0.0 for one in estimates]
    axes.errorbar(
        at, values, yerr=[low, high], color=colour, marker=marker, capsize=4, linewidth=1.2,
        label=textwrap.fill(label, _LABEL_WIDTH) or None,
    )  # fmt: skip


def _figure(height: float = _SIZE[1]) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(_SIZE[0], height), layout="constrained")
    FigureCanvasSVG(figure)
    axes = figure.add_subplot()
    axes.grid(color="#ddd", linewidth=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return figure, axes


def _svg(figure: Figure) -> str:
    """The figure as an element of a page, the same bytes for the same figure."""
    file = io.StringIO()
    figure.savefig(file, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    element = file.getvalue().partition("<svg ")[2]
    text = re.sub(r"<metadata>.*?</metadata>\s*", "", f"<svg {element}", flags=re.DOTALL)
    text = re.sub(
        r'(<svg [^>]*?)width="[^"]*" height="[^"]*"|(<svg [^>]*?)height="[^"]*" width="[^"]*"', r"\1\2", text, count=1
    )
    return "\n".join(line.rstrip() for line in text.splitlines())


def _wrapped(comparison: Comparison) -> str:
    lines = f"{comparison.label}\n– {comparison.reference}".replace(", ", ",\n").splitlines()
    return "\n".join(textwrap.fill(line, _LABEL_WIDTH) for line in lines)
