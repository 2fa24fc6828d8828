"""What the examples of learning share: options, the scores of runs on seeds apart, and a picture of the curves."""

import argparse
from collections.abc import Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.stats import t as student_t

from touchline.learn import scores

Curve = list[tuple[float, float]]
"""Minutes of CPU time, and the mean score of the newest episodes then."""
Team = tuple[str | None, dict[str, Any]]
"""The brain of a run, None for the baseline, and the keys of the match file that it needs."""


def parser_of(description: str | None) -> argparse.ArgumentParser:
    """The options of all examples."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=5, help="each from a seed of its own")
    parser.add_argument("--minutes", type=float, default=4.0, help="CPU time of each run")
    parser.add_argument("--episodes", type=int, default=100, help="episodes that score a run")
    parser.add_argument("--jobs", type=int, default=None, help="processes; by default one per core")
    return parser


def report(pool: Executor, task: str, runs: dict[str, Team], curves: list[Curve], folder: Path, episodes: int) -> None:
    """Print the score of the baseline and of each run, by its name, over the seeds from 1 on, and draw the curves.

    What runs have more than the baseline is uncertain by the runs, and by the seeds, which all of them play.
    """
    seeds = range(1, episodes + 1)
    teams: dict[str, Team] = {"baseline": (None, {}), **runs}
    begun = {name: pool.submit(scores, task, seeds, *team) for name, team in teams.items()}
    for name, one in begun.items():
        print(f"{name}: {text_of(one.result())}")
    baseline = np.array(begun["baseline"].result())
    more = np.array([begun[name].result() for name in runs]) - baseline
    print(f"more than the baseline, over {len(runs)} runs: {text_of(more.mean(axis=1))}")
    print(f"more than the baseline, over {episodes} seeds: {text_of(more.mean(axis=0))}")
    draw(folder / "curve.png", task, curves, float(baseline.mean()))
    print(folder / "curve.png")


def text_of(values: Sequence[float] | np.ndarray) -> str:
    """A mean with its interval of 95 %."""
    mean = float(np.mean(values))
    if len(values) < 2:
        return f"{mean:.3g}"
    half = float(student_t.ppf(0.975, len(values) - 1)) * float(np.std(values, ddof=1)) / len(values) ** 0.5
    return f"{mean:.3g} ({mean - half:.3g} to {mean + half:.3g})"


def draw(file: Path, task: str, curves: list[Curve], baseline: float) -> None:
    """One line a run, and the score of the baseline."""
    figure = Figure(figsize=(6.0, 3.6), layout="constrained")
    axes = figure.subplots()
    for run, curve in enumerate(curves, 1):
        axes.plot([at for at, _ in curve], [score for _, score in curve], label=f"run {run}")
    axes.axhline(baseline, color="black", linestyle="--", label="baseline")
    axes.set(title=task, xlabel="CPU time in minutes", ylabel="score in training")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(file, dpi=110)
