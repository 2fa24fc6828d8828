"""Plays in real time and checks that no process of the match grows: memory, threads, file descriptors.

    .venv/bin/python benchmarks/check_soak.py --minutes 10

The first three minutes are warm-up: the histories of topics are full after 30 s, the record batches that a host keeps
after 48 s, and the memory of a process stays the same a minute or two later. Exit status 1 if a process grows beyond
the limits after that, or has ended.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path
from statistics import linear_regression
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from support.process_story import Program, is_running, wait_for

MB_A_MINUTE = 1.0
"""Most growth of a process's memory, by a line through its samples."""
MORE_THREADS, MORE_FILES = 2, 4
"""Most that the newest counts exceed those after the warm-up."""
WARM_UP_MINUTES = 3.0
"""Wall time in which a process may grow."""
LEAST_MINUTES = 2 * WARM_UP_MINUTES
"""Shortest check: growth is judged over at least as much time as the warm-up."""
SETTLE_S = 10.0
"""Wall time after which the processes that only start others have ended."""
EVERY_S = 2.0
"""Wall time between two samples."""


class Sample(NamedTuple):
    """One process at one time."""

    minute: float
    mb: float
    threads: int
    files: int


def sample(pid: int, minute: float) -> Sample:
    """The present figures of a process."""
    status = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
    files = sum(1 for _ in Path(f"/proc/{pid}/fd").iterdir())
    return Sample(minute, int(status["VmRSS"].split()[0]) / 1024, int(status["Threads"]), files)


def faults(samples: list[Sample]) -> list[str]:
    """In what a process grows beyond the limits; `samples` are those after the warm-up."""
    slope = linear_regression([one.minute for one in samples], [one.mb for one in samples]).slope
    first, last = samples[0], samples[-1]
    found = [f"memory grows by {slope:.2f} MB a minute"] if slope > MB_A_MINUTE else []
    if last.threads > first.threads + MORE_THREADS:
        found.append(f"threads grow from {first.threads} to {last.threads}")
    if last.files > first.files + MORE_FILES:
        found.append(f"descriptors grow from {first.files} to {last.files}")
    return found


def main() -> int:
    """Play, sample and judge."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="wall time of the match")
    arguments = parser.parse_args()
    if arguments.minutes < LEAST_MINUTES:
        parser.error(f"--minutes is {arguments.minutes:g}; at least {LEAST_MINUTES:g}, half of them are warm-up")
    seconds = 60.0 * arguments.minutes
    with tempfile.TemporaryDirectory() as folder:
        words = ["touchline", "match", "--web", "--pace", "realtime", "--duration", str(round(2 * seconds + 600))]
        program = Program(words, Path(folder), "match", {})
        try:
            names = ("host", "recorder", "cyan1", "magenta1")
            wait_for(lambda: set(names) <= set(program.processes()), f"the processes; {program.err}")
            time.sleep(SETTLE_S)
            pids, begin = program.processes(), time.monotonic()
            samples: dict[str, list[Sample]] = {name: [] for name in pids}
            while (elapsed := time.monotonic() - begin) < seconds:
                for name, pid in pids.items():
                    if not is_running(pid):
                        sys.stderr.write(f"{name} has ended; {program.err}\n")
                        return 1
                    samples[name].append(sample(pid, elapsed / 60.0))
                time.sleep(EVERY_S)
        finally:
            program.end()
    failed = False
    for name, all_of_it in samples.items():
        settled = [one for one in all_of_it if one.minute >= WARM_UP_MINUTES]
        found = faults(settled)
        failed |= bool(found)
        first, last = settled[0], settled[-1]
        print(
            f"{name}: {first.mb:.0f} → {last.mb:.0f} MB, {first.threads} → {last.threads} threads, "
            f"{first.files} → {last.files} descriptors; {', '.join(found) or 'no growth'}"
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
