"""Prints the lines of each package beside its budget, and all wall times; exit status 1 if there are more.

The budgets are in `budgets.toml`. A change that needs more lines adds a row to `growth` there, with its reason.
"""

import ast
import re
import sys
import tomllib
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).parent.parent
PACKAGES = ("schemas", "runtime", "sim_host", "robot_agent", "recordings", "coach_gateway", "touchline")
SUFFIXES = (".py", ".js")
_OF_TIME = re.compile(r"_(S|MS|US|NS)\b")
_BARE_WAIT = re.compile(
    r"(timeout=|patience=|now\(\) \+ |EndStep\(|(receive|progress|result|sleep|wait|poll|call_later|timeout)\()"
    r"[\d.]*[1-9](?! \*)"
)
"""A wait for a number of seconds in place of a constant with its reason."""


def lines(folder: Path) -> int:
    """All lines of the Python and JavaScript files below this folder."""
    files = (path for path in folder.rglob("*") if path.suffix in SUFFIXES)
    return sum(len(path.read_text("utf-8").splitlines()) for path in files)


def wall_times() -> tuple[int, list[str]]:
    """Numbers of the packages' tables of wall times and of constants whose docstrings name them so; and bare waits."""
    count, bare = 0, []
    for path in sorted(file for package in PACKAGES for file in (ROOT / package).rglob("*.py")):
        text = path.read_text("utf-8")
        count += sum(_numbers(path.name == "timing.py", one, after) for one, after in pairwise(ast.parse(text).body))
        found = ((number, line) for number, line in enumerate(text.splitlines(), 1) if _BARE_WAIT.search(line))
        bare += [f"{path.relative_to(ROOT)}:{number}: {line.strip()}" for number, line in found]
    return count, bare


def _numbers(in_table: bool, node: ast.stmt, after: ast.stmt) -> int:
    """Numbers in an assignment of wall times, which its own docstring names so outside of a table."""
    docstring = ast.unparse(after).lower() if isinstance(after, ast.Expr) else ""
    if not isinstance(node, ast.Assign) or not _OF_TIME.search(ast.unparse(node.targets[-1])):
        return 0
    if not in_table and ("wall time" not in docstring or "simulated time" in docstring):
        return 0
    return sum(isinstance(each, ast.Constant) for each in ast.walk(node.value))


def main() -> int:
    """Print a row a package."""
    budgets = tomllib.loads((ROOT / "budgets.toml").read_text("utf-8"))
    (times, bare), most = wall_times(), budgets.pop("wall_times")["most"]
    over = [f"wall times are {times} numbers, {times - most} too many"] if times > most else []
    over += [f"{line}: a bare wait" for line in bare]
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
