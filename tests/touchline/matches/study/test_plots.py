"""The plots of a report, on constructed results."""

from collections.abc import Callable
from typing import Any

import pytest

plots = pytest.importorskip("touchline.matches.study.plots", reason="experiments need the extra study")

from touchline.matches.statistics.paired import seed_means  # noqa: E402
from touchline.matches.study.comparisons import compared  # noqa: E402


def test_the_name_of_a_level_is_drawn_as_it_is_written_whatever_its_letters_and_however_long(
    bare_plan: Callable[[str], Any], table: Callable[..., Any]
) -> None:
    levels = ["$^$", "<img src=x onerror=steal()> " * 3]
    plan = bare_plan(f'both_sides = false\nresponses = ["goals"]\n[factors]\nteams.cyan.name = {levels}')
    results = table("goals", {1: [1, 2, 2], 2: [3, 5, 4]})
    (group, *_) = compared(plan, results)["goals"]
    drawn = [
        plots.plot_of_means(seed_means(results, "goals", 1), plan.cells, "goals"),
        plots.plot_of_comparisons(group.comparisons, "goals"),
    ]
    assert all("$^$" in svg and "&lt;img" in svg and "<img" not in svg for svg in drawn)
