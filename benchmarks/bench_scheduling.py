"""Many matches: what the engine of plans adds to them, how it uses the cores, and whether memory stays flat.

`overhead` is the wall time of a match less that of its play alone, from its start to its stored outcome. `speed-up`
plays the same matches on one core and on all, in turns. `flat` plays many short matches and follows the memory of the
process that plans them.
"""

import argparse
import resource
import statistics
import tempfile
import time
from pathlib import Path

from schemas.config.match_config import MatchConfig, load_match
from touchline.play import play_match
from touchline.scheduling.child_processes import ChildProcesses, cores
from touchline.scheduling.outcome import Outcome
from touchline.scheduling.plan import ListPlan
from touchline.scheduling.planned_match import PlannedMatch, Way
from touchline.scheduling.run import run_plan
from touchline.scheduling.store import RunStore

MOST_OVERHEAD_S = {Way.IN_PROCESS: 0.1, Way.PROCESSES: 1.5}
LEAST_SPEED_UP = 1.8
"""With two cores."""
MOST_GROWTH_MB = 20.0


class Silent:
    """Shows nothing, and notes the memory of this process."""

    def __init__(self) -> None:
        self.memory: list[float] = []

    def planned(self, done: int, due: int) -> None:
        """Nothing to show."""

    def ended(self, planned: PlannedMatch, outcome: Outcome) -> None:
        """Note the memory, in MB."""
        del planned, outcome
        self.memory.append(memory_mb())


def memory_mb() -> float:
    """Resident memory of this process in MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def match_of(seed: int, duration: float) -> MatchConfig:
    """A match of the teams that ship."""
    return load_match(None, {"seed": seed, "duration": duration})


def run(matches: list[PlannedMatch], jobs: int) -> tuple[float, dict[str, float], list[float]]:
    """Wall time of all matches, of each, and the memory after each."""
    log = Silent()
    with tempfile.TemporaryDirectory() as folder, ChildProcesses(jobs) as executor, RunStore(Path(folder)) as store:
        began = time.perf_counter()
        run_plan(ListPlan(tuple(matches)), executor, store, log)
        return time.perf_counter() - began, dict(store.wall_times()), log.memory


def overhead(way: Way, duration: float, rounds: int) -> float:
    """Median wall time of a planned match less that of its play alone, in s; the two in turns."""
    differences = []
    run([PlannedMatch(match_of(1, 1.0))], 1)  # the fork server has been started
    for seed in range(1, rounds + 1):
        whole = run([PlannedMatch(match_of(seed, duration), way=way)], 1)[0]
        shorter = run([PlannedMatch(match_of(seed, duration / 2), way=way)], 1)[0]
        differences.append(2 * shorter - whole)
    return statistics.median(differences)


def main() -> None:
    """Print all figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--matches", type=int, default=28, help="matches of the speed-up")
    parser.add_argument("--duration", type=float, default=120.0, help="s of each of them")
    parser.add_argument("--flat", type=int, default=1000, help="matches of 30 s whose memory is followed")
    parser.add_argument("--rounds", type=int, default=5, help="rounds of the overhead")
    options = parser.parse_args()
    for way, most in MOST_OVERHEAD_S.items():
        figure = overhead(way, 20.0, options.rounds)
        print(f"overhead of a match, {way.value}: {figure:.2f} s (limit {most:g})", flush=True)
    matches = [PlannedMatch(match_of(seed, options.duration)) for seed in range(1, options.matches + 1)]
    alone, many = run(matches, 1)[0], run(matches, cores())[0]
    print(
        f"{options.matches} matches of {options.duration:g} s: {alone:.0f} s one at a time, {many:.0f} s on "
        f"{cores()} cores: {alone / many:.2f} x (limit {LEAST_SPEED_UP:g})",
        flush=True,
    )
    short = [PlannedMatch(match_of(seed, 30.0)) for seed in range(1, options.flat + 1)]
    took, _, memory = run(short, cores())
    growth = memory[-1] - memory[len(memory) // 10]
    print(
        f"{options.flat} matches of 30 s: {options.flat / took * 3600:.0f} matches an hour, "
        f"{options.flat * 30.0 / took / cores():.1f} simulated s in a s of a core; memory {memory[-1]:.0f} MB, "
        f"{growth:+.1f} MB since the first tenth (limit {MOST_GROWTH_MB:g})"
    )
    began = time.perf_counter()
    play_match(match_of(1, 30.0))
    print(f"a match of 30 s by play_match alone: {time.perf_counter() - began:.2f} s")


if __name__ == "__main__":
    main()
