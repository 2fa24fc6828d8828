"""Prints the lines of each package beside its budget, and all wall times; exit status 1 if there are more.

The budgets are in `budgets.toml`. A change that needs more lines adds a row to `growth` there, with its reason.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
SUFFIXES = (".py", ".js")
_NUMBER = re.compile(r"\d[\d_.e-]*")


def lines(folder: Path) -> int:
    """All lines of the Python and JavaScript files below this folder."""
    files = (path for path in folder.rglob("*") if path.suffix in SUFFIXES)
    return sum(len(path.read_text("utf-8").splitlines()) for path in files)


def wall_times() -> int:
    """Numbers in the packages' tables of wall times, `timing.py`."""
    tables = [path for pattern in ("*/timing.py", "*/process/timing.py") for path in ROOT.glob(pattern)]
    found = [
        re.match(r"[A-Z_, ]+_(?:S|MS|US)\b[^=]*=(.*)", line)
        for path in tables
        for line in path.read_text("utf-8").splitlines()
    ]
    return sum(len(_NUMBER.findall(row[1])) for row in found if row)


def main() -> int:
    """Print a row a package."""
    budgets = tomllib.loads((ROOT / "budgets.toml").read_text("utf-8"))
    times, most = wall_times(), budgets.pop("wall_times")["most"]
    over = [f"the tables of wall times have {times} numbers, {times - most} too many"] if times > most else []
    sys.stdout.write(f"{'wall times':15}{times:7} numbers, budget {most:4}\n")
    for package, budget in budgets.items():
        limit = budget["lines"] + sum(row["lines"] for row in budget.get("growth", []))
        now = lines(ROOT / package)
        sys.stdout.write(f"{package:15}{now:7} lines, budget {limit:6}\n")
        if now > limit:
            over.append(f"{package} has {now} lines, {now - limit} more than its budget")
    if over:
        remedy = "merge or delete something, or add a row with lines and reason to `growth` in budgets.toml"
        sys.stderr.write("".join(f"{each}: {remedy}\n" for each in over))
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
