"""This revision against another: ratios of CPU time, both played in turns on the same machine.

`make bench-against REV=main~20` unpacks the other revision and runs it with the packages of this one. Each command is
run with both in turns, the other revision first in every second round. A ratio is that of one round, this revision to
the other; printed are the median and its interval, by the order of the rounds. The whole match stands first: a part
that costs less is worth something only if the whole does, too.
"""

import argparse
import itertools
import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
from collections import Counter
from collections.abc import Iterator
from math import comb
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).parents[1]
PROBE = Path(__file__).parent / "probe_in_process.py"
SAMPLE_S = 0.05
"""s between two looks at the processes; a process may compute this long after the last one unseen."""
CONFIDENCE = 0.9
KINDS = {"sim_host": "host", "recordings": "recorder", "coach_gateway": "gateway"}
"""Package in a process's command → the part of the match; the command itself is the launch, all others are agents."""
RECORDING = "default.mcap"
IDLE = """
rules = "{rules}"

[teams.cyan]
size = {size}
brain = "idle_brain:act"

[teams.magenta]
size = {size}
brain = "idle_brain:act"
"""


class ProcessWatch:
    """Adds up the CPU time of a command's processes, by kind, until the command has ended."""

    def __init__(self, command: subprocess.Popen[bytes]) -> None:
        self._root = command.pid
        self._kinds: dict[int, str] = {self._root: "launch"}
        self._ticks: dict[int, int] = {}
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._watch)
        self._thread.start()

    def seconds(self) -> dict[str, float]:
        """CPU time in s of each kind of process, after the end."""
        self._ended.set()
        self._thread.join()
        found: Counter[str] = Counter()
        for process, ticks in self._ticks.items():
            found[self._kinds[process]] += ticks
        return {kind: ticks / os.sysconf("SC_CLK_TCK") for kind, ticks in found.items()}

    def _watch(self) -> None:
        while not self._ended.wait(SAMPLE_S):
            parents = dict(_stats())
            for process, (parent, ticks) in parents.items():
                known = self._kinds.get(process)
                if known == "agents" or (known is None and parent in self._kinds):
                    self._kinds[process] = _kind(process)  # a fork has its parent's command until it runs its own
                if process in self._kinds:
                    self._ticks[process] = ticks


def _stats() -> Iterator[tuple[int, tuple[int, int]]]:
    """Each process of the machine: its parent, and its CPU time in clock ticks."""
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rsplit(") ", 1)[1].split()
            except (OSError, IndexError):
                continue  # it has ended
            yield int(folder.name), (int(fields[1]), int(fields[11]) + int(fields[12]))


def _kind(process: int) -> str:
    try:
        words = (Path("/proc") / str(process) / "cmdline").read_bytes().decode().split("\0")
    except OSError:
        return "agents"
    return next((kind for package, kind in KINDS.items() if package in words), "agents")


class Revision:
    """A tree of the program, run with the packages of this one's environment."""

    def __init__(self, tree: Path, runs: Path, seconds: float) -> None:
        """`seconds` of play in each match; `runs` is made, and gets recordings and match files."""
        self._seconds = str(seconds)
        self._environment = {**os.environ, "PYTHONPATH": f"{tree}{os.pathsep}{PROBE.parent}"}
        self._runs = runs
        runs.mkdir()
        for size, rules in ((5, "msl"), (11, "eleven")):
            (runs / f"idle{2 * size}.toml").write_text(IDLE.format(size=size, rules=rules))
        subprocess.run([sys.executable, "-m", "compileall", "-q", tree], check=False)

    def default_match(self) -> dict[str, float]:
        """CPU time in s of the default match, and of each kind of its processes."""
        recording = self._runs / RECORDING
        recording.unlink(missing_ok=True)
        kinds = self._match("--seed", "7", "--duration", self._seconds, "--record", recording)
        return {"default match": sum(kinds.values())} | {
            f"default match: {kind}": kinds[kind] for kind in sorted(kinds)
        }

    def verify(self) -> dict[str, float]:
        """CPU time in s of the verification of that match."""
        return {"verify": sum(self._run("-m", "touchline", "verify", self._runs / RECORDING)[0].values())}

    def lockstep(self) -> dict[str, float]:
        """CPU time in s of host and agents, whose brains answer at once."""
        found = {}
        for robots in (10, 22):
            kinds = self._match(f"idle{robots}.toml", "--seed", "7", "--duration", self._seconds)
            found[f"lockstep, {robots} robots: host and agents"] = kinds["host"] + kinds["agents"]
        return found

    def in_process(self) -> dict[str, float]:
        """CPU time in s of matches in one process, and of their parts."""
        found: dict[str, float] = json.loads(self._run(PROBE, self._seconds)[1])
        return found

    def _match(self, *words: str | Path) -> dict[str, float]:
        more = ("--json", "--pace", "lockstep", "--listen", "tcp/127.0.0.1:0")
        return self._run("-m", "touchline", "match", *words, *more)[0]

    def _run(self, *words: str | Path) -> tuple[dict[str, float], bytes]:
        command = subprocess.Popen(
            [sys.executable, *words],
            cwd=self._runs,
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        watch = ProcessWatch(command)
        try:
            out, errors = command.communicate()
        finally:
            spent = watch.seconds()
        if command.returncode:
            sys.exit(f"{' '.join(map(str, words))} in {self._runs}: status {command.returncode}\n{errors.decode()}")
        return spent, out


def unpacked(revision: str, folder: Path) -> Path:
    """The tree of a revision, in a folder of its own."""
    words = ["git", "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}"]
    name = subprocess.run(words, cwd=ROOT, check=False, capture_output=True, text=True).stdout.strip()
    if not name:
        sys.exit(f'"{revision}" is no commit; give one, such as REV=main~20')
    tree = folder / name
    tree.mkdir()
    archive = subprocess.run(["git", "archive", name], cwd=ROOT, check=True, capture_output=True).stdout
    subprocess.run(["tar", "-x", "-C", tree], input=archive, check=True)
    return tree


def interval(ratios: list[float]) -> tuple[float, float]:
    """The narrowest pair of order statistics that holds the median with `CONFIDENCE`; all, if there are too few."""
    ordered, count = sorted(ratios), len(ratios)
    for cut in range((count - 1) // 2, 0, -1):
        outside = 2 * sum(comb(count, k) for k in range(cut + 1)) / 2**count
        if outside <= 1 - CONFIDENCE:
            return ordered[cut], ordered[-1 - cut]
    return ordered[0], ordered[-1]


def main() -> None:
    """Measure both revisions in turns and print the ratios."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("revision", help="a commit, such as main~20")
    parser.add_argument("--rounds", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=20.0, help="simulated time of each match")
    parser.add_argument("--json", action="store_true", help="print every ratio as JSON")
    told = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        this = Revision(ROOT, folder / "this", told.seconds)
        other = Revision(unpacked(told.revision, folder), folder / "other", told.seconds)
        ratios: dict[str, list[float]] = {}
        commands = (Revision.default_match, Revision.verify, Revision.lockstep, Revision.in_process)
        for number, command in itertools.product(range(told.rounds), commands):
            turns = [this, other] if number % 2 else [other, this]
            spent = {revision: command(revision) for revision in turns}
            for measure, seconds in spent[this].items():
                ratios.setdefault(measure, []).append(seconds / spent[other][measure])
    report(ratios, told.revision, as_json=told.json)


def report(ratios: dict[str, list[float]], revision: str, *, as_json: bool) -> None:
    """Print the ratios of each measure."""
    if as_json:
        print(json.dumps(ratios))
        return
    table = Table(title=f"CPU time of this revision to that of {revision}")
    for heading in ("measure", "ratio", f"interval, {CONFIDENCE:.0%}", "all"):
        table.add_column(heading)
    for measure, found in ratios.items():
        low, high = interval(found)
        row: list[Any] = [f"{statistics.median(found):.2f}", f"{low:.2f} to {high:.2f}"]
        table.add_row(measure, *row, " ".join(f"{ratio:.2f}" for ratio in sorted(found)))
    Console().print(table)


if __name__ == "__main__":
    main()
