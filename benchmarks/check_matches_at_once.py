"""Starts several matches in the same second, again and again, and checks that each is the match of its seed alone.

    python benchmarks/check_matches_at_once.py --matches 10 --rounds 20

Exit status 1 if a match differs. It is a check rather than a measurement, and too long for the tests.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from recordings.reading.recording import open_recording
from schemas.topics import APPLIED


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a match was, without its speed."""

    ticks: int
    chain: str
    score: dict[str, int]
    events: list[dict[str, Any]]
    losses: dict[str, int]


def play(seed: int, robots: int, duration: float, folder: Path) -> Outcome | str:
    """The outcome of a match in a process of its own; its error output if it fails."""
    arguments = [f"--seed={seed}", f"--duration={duration}", "--json", str(match_file(robots, folder))]
    command = [sys.executable, "-m", "touchline", "match", *arguments]
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if ended.returncode != 0:
        return f"status {ended.returncode}: {ended.stderr.strip()}"
    result = json.loads(ended.stdout)
    applied = [recorded.message() for recorded in open_recording(folder / result["recording"]).messages(APPLIED.key)]
    return Outcome(result["ticks"], applied[-1].chain, result["score"], result["events"], result["losses"])


def match_file(robots: int, folder: Path) -> Path:
    """A match file for teams of this size."""
    file = folder / "match.toml"
    if not file.exists():
        file.write_text(f"[teams.cyan]\nsize = {robots}\n[teams.magenta]\nsize = {robots}\n")
    return file


def main() -> int:
    """Play each seed alone, then all seeds at once in each round."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--matches", type=int, default=10)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--robots", type=int, default=2, help="on each side")
    parser.add_argument("--duration", type=float, default=2.0, help="simulated s")
    options = parser.parse_args()
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def play_seed(seed: int) -> Outcome | str:
            return play(seed, options.robots, options.duration, folder)

        seeds = range(1, options.matches + 1)
        alone = {seed: play_seed(seed) for seed in seeds}
        for number in range(1, options.rounds + 1):
            began = time.monotonic()
            with ThreadPoolExecutor(len(seeds)) as pool:
                together = dict(zip(seeds, pool.map(play_seed, seeds), strict=True))
            different = {seed: outcome for seed, outcome in together.items() if outcome != alone[seed]}
            wrong += len(different)
            took = time.monotonic() - began
            print(f"round {number}: {len(seeds) - len(different)} of {len(seeds)} right, {took:.1f} s", flush=True)
            for seed, outcome in different.items():
                print(f"  seed {seed} alone: {alone[seed]}\n  at once: {outcome}")
    print(f"{wrong} of {options.rounds * len(seeds)} matches differ from the match of the same seed alone")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
