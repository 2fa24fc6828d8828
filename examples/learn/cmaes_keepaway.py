"""Tunes the numbers of the keepers of keepaway_3v2 by CMA-ES, and plays them on seeds of their own.

    pip install 'touchline[sim,learn,study]' cmaes
    python examples/learn/cmaes_keepaway.py

The candidates of a generation play the same episodes, and those of the next one others. What a run finds are parameters
of the team, for [teams.cyan.parameters] of a match file. A picture of the curves is left in runs/cmaes-keepaway_3v2.
"""

import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from report import Curve, parser_of, report

from touchline.learn import scores

try:
    from cmaes import CMA
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}; pip install cmaes") from None

TASK = "keepaway_3v2"
NUMBERS = {"pressed": (1.0, 2.2, 4.0), "long": (1.0, 3.0, 4.8), "corner": (3.0, 4.0, 5.0), "arriving": (2.0, 3.5, 5.0)}
"""Least value, that of the baseline and largest value of each number; touchline/tasks/keepaway_3v2.py explains them."""
EPISODES = 6
"""Episodes of a candidate in a generation."""
STEP = 0.15
"""Standard deviation of the first generation, as a share of each range."""


def overrides_of(candidate: np.ndarray) -> dict[str, float]:
    """The keys of the match file with the numbers of a candidate, whose entries are from 0 to 1."""
    return {
        f"teams.cyan.parameters.{name}": round(low + float(share) * (high - low), 3)
        for (name, (low, _, high)), share in zip(NUMBERS.items(), candidate, strict=True)
    }


def tune(run: int, minutes: float) -> tuple[dict[str, float], Curve]:
    """The numbers in the middle of the last generation, and the mean score of each generation."""
    begun, curve = time.process_time(), []
    start = np.array([(middle - low) / (high - low) for low, middle, high in NUMBERS.values()])
    search = CMA(mean=start, sigma=STEP, bounds=np.array([[0.0, 1.0]] * len(start)), seed=run)
    first = 1_000_000 * run
    while time.process_time() < begun + 60 * minutes:
        candidates = [search.ask() for _ in range(search.population_size)]
        seeds = range(first + len(curve) * EPISODES, first + (len(curve) + 1) * EPISODES)
        means = [float(np.mean(scores(TASK, seeds, None, overrides_of(one)))) for one in candidates]
        search.tell([(one, -score) for one, score in zip(candidates, means, strict=True)])
        curve.append(((time.process_time() - begun) / 60, float(np.mean(means))))
    return overrides_of(np.clip(search.mean, 0.0, 1.0)), curve


def main() -> None:
    """Tune, score, draw."""
    options = parser_of(__doc__).parse_args()
    folder = Path("runs") / f"cmaes-{TASK}"
    folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(options.jobs, get_context("spawn")) as pool:
        begun = [pool.submit(tune, run, options.minutes) for run in range(1, options.runs + 1)]
        tuned = [one.result() for one in begun]
        runs = {}
        for run, (found, _) in enumerate(tuned, 1):
            numbers = ", ".join(f"{key.rpartition('.')[2]} {value}" for key, value in found.items())
            runs[f"run {run}, {numbers}"] = (None, found)
        report(pool, TASK, runs, [curve for _, curve in tuned], folder, options.episodes)


if __name__ == "__main__":
    main()
