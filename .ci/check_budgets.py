"""Prints the lines of each package beside its budget; exit status 1 if a package is over it.

The budgets are in `budgets.toml`. A change that needs more lines adds a row to `growth` there, with its reason.
"""

import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
SUFFIXES = (".py", ".js")


def lines(folder: Path) -> int:
    """All lines of the Python and JavaScript files below this folder."""
    files = (path for path in folder.rglob("*") if path.suffix in SUFFIXES)
    return sum(len(path.read_text("utf-8").splitlines()) for path in files)


def main() -> int:
    """Print a row a package."""
    budgets = tomllib.loads((ROOT / "budgets.toml").read_text("utf-8"))
    over = []
    for package, budget in budgets.items():
        limit = budget["lines"] + sum(row["lines"] for row in budget.get("growth", []))
        now = lines(ROOT / package)
        sys.stdout.write(f"{package:15}{now:7} lines, budget {limit:6}\n")
        if now > limit:
            over.append(f"{package} has {now} lines, {now - limit} more than its budget")
    if over:
        remedy = "delete something, or add a row with lines and reason to `growth` in budgets.toml"
        sys.stderr.write("".join(f"{each}: {remedy}\n" for each in over))
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
