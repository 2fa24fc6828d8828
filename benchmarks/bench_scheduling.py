"""Many matches: what the engine of plans adds to them, how it uses the cores, and whether memory stays flat.

* `overhead`: from the submission of a match to its first tick, and from its last tick to its stored outcome. Wall time
  depends on what else the machine does; CPU time does so much less. With processes, the CPU time is that of all
  processes of a match, extrapolated from two lengths to a match without a tick.
* `speed-up`: the same matches one at a time, and on all cores.
* `many`: many short matches in one process each; memory of the process that plans them, and of the matches.
* `resume`: the time until a run with many stored outcomes goes on.

For example: bench_scheduling.py many --matches 1000 --seconds 30
"""

import argparse
import hashlib
import json
import os
import resource
import statistics
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from recordings.reading.recording import open_recording
from schemas.config.match_config import MatchConfig, load_match
from schemas.topics import APPLIED
from sim_host.match.simulation import TickResult
from touchline.matches.engine.fresh_process import FreshProcesses, cores
from touchline.matches.engine.outcome import Outcome, Played
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch, Way
from touchline.matches.engine.play import play
from touchline.matches.engine.run import run_plan
from touchline.matches.engine.store import RunStore
from touchline.play.play_match import InProcessMatch

MOST_OVERHEAD_S = {Way.IN_PROCESS: 0.1, Way.PROCESSES: 1.5}
LEAST_SPEED_UP = 1.8
"""With two cores."""
MOST_GROWTH_MB = 20.0
"""Of the process that plans, in a run of 1,000 matches."""
MOST_RESUME_S = 0.5
ROUNDS = 5
"""Matches of which the overhead is the median."""


@dataclass(frozen=True)
class Timing:
    """Instants of a match in s: wall time since 1970, and CPU time of its process."""

    first_tick: float
    last_tick: float
    cpu_first_tick: float
    cpu_last_tick: float
    cpu_end: float
    memory_mb: float
    """Most resident memory of its process."""


class Log:
    """Shows nothing, and notes when each match has ended and the memory of this process then."""

    def __init__(self) -> None:
        self.memory: list[float] = []
        self.ended_at: dict[str, float] = {}

    def __call__(self, planned: PlannedMatch, outcome: Outcome) -> str:
        """Note the time, and the memory in MB."""
        assert isinstance(outcome, Played), outcome
        self.ended_at[planned.identity] = time.time()
        self.memory.append(memory_mb())
        return planned.label


class TimedProcesses(FreshProcesses):
    """Child processes that note the instants of their matches in a folder."""

    def __init__(self, jobs: int, folder: Path) -> None:
        super().__init__(jobs)
        self.folder = folder

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call the function of a planned match."""
        return super().submit(timed, fn, str(self.folder), *args, **kwargs)

    def timing(self, planned: PlannedMatch) -> Timing:
        """The instants of a match that has ended."""
        return Timing(**json.loads((self.folder / planned.identity).read_text()))


def timed(play_planned: Callable[..., Any], folder: str, planned: PlannedMatch, note: Path) -> Any:
    """Play a match, and note its instants."""
    first: list[float] = []
    last = [0.0, 0.0]

    step = InProcessMatch.step

    def timed_step(match: InProcessMatch) -> TickResult:
        tick = step(match)
        last[:] = time.time(), time.process_time()
        if not first:
            first[:] = last
        return tick

    InProcessMatch.step = timed_step  # type: ignore[assignment, method-assign]
    outcome = play_planned(planned, note)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    timing = Timing(first[0], last[0], first[1], last[1], time.process_time(), memory)
    (Path(folder) / planned.identity).write_text(json.dumps(asdict(timing)))
    return outcome


def memory_mb() -> float:
    """Resident memory of this process in MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def match_of(seed: int, seconds: float) -> MatchConfig:
    """A match of the teams that ship."""
    return load_match(None, {"seed": seed, "duration": seconds})


def planned_matches(matches: int, seconds: float) -> list[PlannedMatch]:
    """Matches that differ in their seeds."""
    return [PlannedMatch(match_of(seed, seconds)) for seed in range(1, matches + 1)]


def in_one_process(rounds: int, seconds: float) -> tuple[float, float]:
    """Median overhead of a match in one process: wall time and CPU time in s."""
    wall, cpu = [], []
    with tempfile.TemporaryDirectory() as name, TimedProcesses(1, Path(name)) as executor:
        for planned in planned_matches(rounds + 1, seconds):
            log = Log()
            with tempfile.TemporaryDirectory() as folder, closing(RunStore(Path(folder))) as store:
                here, began = time.process_time(), time.time()
                run_plan(ListPlan((planned,)), executor, store, log)
                here = time.process_time() - here
            timing = executor.timing(planned)
            wall.append(timing.first_tick - began + log.ended_at[planned.identity] - timing.last_tick)
            cpu.append(timing.cpu_first_tick + timing.cpu_end - timing.cpu_last_tick + here)
    return statistics.median(wall[1:]), statistics.median(cpu[1:])  # the first one starts the fork server


def with_processes(rounds: int, seconds: float) -> tuple[float, float]:
    """Median overhead of a match with processes: wall time and CPU time in s."""
    wall, cpu = [], []
    with tempfile.TemporaryDirectory() as name, TreeTimedProcesses(1, Path(name)) as executor:
        _over_zenoh(match_of(0, 1.0), executor)  # the fork server has been started
        for seed in range(1, rounds + 1):
            used, began, first, last, ended = _over_zenoh(match_of(seed, seconds), executor)
            wall.append(first - began + ended - last)
            cpu.append(2 * _over_zenoh(match_of(seed, seconds / 2), executor)[0] - used)
    return statistics.median(wall), statistics.median(cpu)


class TreeTimedProcesses(TimedProcesses):
    """Child processes that note the CPU time of all processes of their matches."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call the function of a planned match."""
        return FreshProcesses.submit(self, tree_timed, fn, str(self.folder), *args, **kwargs)


def tree_timed(play_planned: Callable[..., Any], folder: str, planned: PlannedMatch, note: Path) -> Any:
    """Play a match, and note the CPU time of all its processes."""
    outcome = play_planned(planned, note)
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    running = 0.0
    for child in Path("/proc/self/task").glob("*/children"):
        for pid in child.read_text().split():
            fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            running += sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")  # its own, and of its children
    (Path(folder) / planned.identity).write_text(str(time.process_time() + ended.ru_utime + ended.ru_stime + running))
    return outcome


def _over_zenoh(config: MatchConfig, executor: TimedProcesses) -> tuple[float, float, float, float, float]:
    """CPU time of all processes of a match; when it began, its first tick and its last, and when it ended."""
    with tempfile.TemporaryDirectory() as name, closing(RunStore(Path(name))) as store:
        recording = Path(name) / "match.mcap"
        planned = PlannedMatch(config, way=Way.PROCESSES, recording=recording)
        log, began = Log(), time.time()
        run_plan(ListPlan((planned,)), executor, store, log)
        ticks = [message.sent_ns / 1e9 for message in open_recording(recording).messages(APPLIED.key)]
        used = float((executor.folder / planned.identity).read_text())
        return used, began, ticks[0], ticks[-1], log.ended_at[planned.identity]


def overhead(matches: int, seconds: float) -> None:
    """Print what the engine adds to a match."""
    for way, measure in ((Way.IN_PROCESS, in_one_process), (Way.PROCESSES, with_processes)):
        wall, cpu = measure(matches, seconds)
        print(
            f"overhead of a match, {way.value}: {wall:.3f} s of wall time (limit {MOST_OVERHEAD_S[way]:g}), "
            f"{cpu:.3f} s of CPU time; load {os.getloadavg()[0]:.1f}",
            flush=True,
        )


def run(matches: list[PlannedMatch], jobs: int) -> tuple[float, Log, list[Timing]]:
    """Wall time of all matches, what was noted as they ended, and their instants."""
    log = Log()
    with (
        tempfile.TemporaryDirectory() as folder,
        tempfile.TemporaryDirectory() as instants,
        TimedProcesses(jobs, Path(instants)) as executor,
        closing(RunStore(Path(folder))) as store,
    ):
        began = time.perf_counter()
        run_plan(ListPlan(tuple(matches)), executor, store, log)
        took = time.perf_counter() - began
        return took, log, [executor.timing(one) for one in matches]


def speed_up(matches: int, seconds: float) -> None:
    """Print how much faster all cores are than one."""
    planned = planned_matches(matches, seconds)
    alone, many = run(planned, 1)[0], run(planned, cores())[0]
    print(
        f"{matches} matches of {seconds:g} s: {alone:.0f} s one at a time, {many:.0f} s on {cores()} cores: "
        f"{alone / many:.2f} x (limit {LEAST_SPEED_UP:g})",
        flush=True,
    )


def many(matches: int, seconds: float) -> None:
    """Print rate and memory of many short matches."""
    before = memory_mb()
    took, log, timings = run(planned_matches(matches, seconds), cores())
    used = sum(one.cpu_end for one in timings)
    memory = log.memory
    print(
        f"{matches} matches of {seconds:g} s: {took:.0f} s on {cores()} cores, {matches / took * 3600:.0f} matches an "
        f"hour, {matches * seconds / took / cores():.1f} simulated s in a s of a core, {matches * seconds / used:.1f} "
        f"in a s of CPU time"
    )
    growth = memory[-1] - memory[len(memory) // 10]
    print(
        f"memory of the process that plans: {before:.0f} MB before the first match, {memory[0]:.0f} MB after it, "
        f"{memory[len(memory) // 2]:.0f} MB in the middle, {memory[-1]:.0f} MB at the end; {growth:+.1f} MB since the "
        f"first tenth (limit {MOST_GROWTH_MB:g})"
    )
    tenth = max(1, matches // 10)
    first, last = (max(one.memory_mb for one in part) for part in (timings[:tenth], timings[-tenth:]))
    print(f"most memory of a match: {first:.0f} MB in the first tenth, {last:.0f} MB in the last", flush=True)


def resume(matches: int, seconds: float) -> None:
    """Print how long it takes to read the outcomes of a run that is resumed."""
    played = play(PlannedMatch(match_of(1, seconds)))
    with tempfile.TemporaryDirectory() as folder:
        with closing(RunStore(Path(folder))) as store:
            for number in range(matches):
                store.add(replace(played, identity=hashlib.sha256(bytes(str(number), "ascii")).hexdigest()[:32]))
        began, used = time.perf_counter(), time.process_time()
        with closing(RunStore(Path(folder))) as store:
            outcomes = store.outcomes()
            read, cpu = time.perf_counter() - began, time.process_time() - used
            began = time.perf_counter()
            assert sum(isinstance(one, Played) for one in outcomes.values()) == matches
            decoded = time.perf_counter() - began
    print(
        f"{matches} outcomes: read in {read:.2f} s (limit {MOST_RESUME_S:g}), {cpu:.2f} s of CPU time; "
        f"all of them decoded in {decoded:.2f} s",
        flush=True,
    )


PARTS: dict[str, tuple[Callable[[int, float], None], int, float]] = {
    "overhead": (overhead, ROUNDS, 10.0),
    "speed-up": (speed_up, 28, 120.0),
    "many": (many, 1000, 30.0),
    "resume": (resume, 2000, 20.0),
}
"""What can be measured, with its number of matches and the length of each in s."""


def main() -> None:
    """Print all figures, or those of one part."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", nargs="?", choices=PARTS, help="what to measure; by default everything")
    parser.add_argument("--matches", type=int, help="number of matches; by default that of the part")
    parser.add_argument("--seconds", type=float, help="length of each in s; by default that of the part")
    options = parser.parse_args()
    for name, (measure, matches, seconds) in PARTS.items():
        if options.part in (None, name):
            measure(options.matches or matches, options.seconds or seconds)


if __name__ == "__main__":
    main()
