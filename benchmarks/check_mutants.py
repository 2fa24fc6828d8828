"""Changes the program in random places, one at a time, and counts how many of the changes the tests notice.

    python benchmarks/check_mutants.py --sample 60 --seed 1 --area referee

mutmut makes the changes (mutants) and runs, for each, the tests that reach the changed function. It keeps results in
`mutants/`; without `--sample` all mutants are tried, which takes a day. An area passes if at least 85 % are caught.
Survivors are printed as differences. Exit status 1 if an area does not pass.
"""

import argparse
import math
import random
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

AREAS = {
    "referee": "sim_host.soccer.referee.",
    "actuation": "sim_host.actuation.",
    "ball": "sim_host.soccer.ball.",
    "sensing": "sim_host.sensing.",
    "bus": "runtime.bus.",
    "recordings": "recordings.",
}
"""Area → beginning of the names of its mutants; `only_mutate` in pyproject.toml lists the same folders."""
SMALLEST = "sim_host.sensing.shutter.*"
"""Mutants that are tried first, so that all are generated and listed."""
CAUGHT_AT_LEAST = 0.85
CAUGHT = ("killed", "timeout", "segfault", "suspicious")
"""Results of mutmut that count as caught: a test failed, did not end, or its process died."""
MUTMUT = str(Path(sys.executable).with_name("mutmut"))


def results() -> dict[str, str]:
    """Mutant → its result, as mutmut lists them."""
    listed = subprocess.run([MUTMUT, "results", "--all", "true"], capture_output=True, text=True, check=True).stdout
    pairs = (line.strip().rsplit(": ", 1) for line in listed.splitlines() if ": " in line)
    return dict(pair for pair in pairs)


def run(mutants: Sequence[str]) -> None:
    """Try these mutants; mutmut's own output goes to standard error."""
    subprocess.run([MUTMUT, "run", *mutants], check=True, stdout=sys.stderr)


def interval(caught: int, tried: int) -> tuple[float, float]:
    """95 % confidence interval of a share (Wilson score)."""
    z, share = 1.96, caught / tried
    middle = (share + z * z / (2 * tried)) / (1 + z * z / tried)
    half = z / (1 + z * z / tried) * math.sqrt(share * (1 - share) / tried + z * z / (4 * tried * tried))
    return middle - half, middle + half


def main() -> int:
    """Print a line for each area, and the survivors."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sample", type=int, help="mutants of each area, chosen at random; all by default")
    parser.add_argument("--seed", type=int, default=1, help="of the choice")
    parser.add_argument("--area", choices=AREAS, action="append", help="may be repeated; all by default")
    options = parser.parse_args()
    run([SMALLEST])
    known = sorted(results())
    chosen = {}
    for area in options.area or AREAS:
        names = [name for name in known if name.startswith(AREAS[area])]
        draw = random.Random(f"{options.seed} {area}")
        chosen[area] = draw.sample(names, min(options.sample or len(names), len(names)))
    run([name for names in chosen.values() for name in names])
    after, passed = results(), True
    for area, names in chosen.items():
        caught = sum(after[name] in CAUGHT for name in names)
        low, high = interval(caught, len(names))
        print(f"{area}: {caught} of {len(names)} caught, {caught / len(names):.0%} ({low:.0%} to {high:.0%})")
        passed = passed and caught >= CAUGHT_AT_LEAST * len(names)
        for name in names:
            if after[name] not in CAUGHT:
                print(subprocess.run([MUTMUT, "show", name], capture_output=True, text=True, check=True).stdout)
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
