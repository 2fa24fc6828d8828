"""Writes docs/parity.md from docs/parity.toml: `python docs/parity.py > docs/parity.md`."""

import ast
import tomllib
from collections.abc import Iterator
from difflib import get_close_matches
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
TABLE = ROOT / "docs" / "parity.toml"
INTRODUCTION = """\
# Compared with the simulation system of the NuBot team

<!-- Written by `python docs/parity.py > docs/parity.md`; edit docs/parity.toml. -->

What these systems and tools do, whether Touchline does it, and which test shows it:

* **The paper**: W. Yao, W. Dai, J. Xiao, H. Lu, Z. Zheng, *A Simulation System Based on ROS and Gazebo for RoboCup
  Middle Size League* (2015), and its code, nubot-nudt/single_nubot_gazebo.
* **simatch**: its successor for two teams, with coach and automatic referee (nubot-nudt/gazebo_visual and
  nubot-nudt/simatch).
* **The league's tools**: the referee box, and the requirements that the Middle Size League wrote down for a simulator
  of its own (RoboCup-MSL/RefBox and RoboCup-MSL/MSL-Simulator).

`touchline match matches/paper.toml` plays on the pitch of the paper with its robots, noise and physics step. Every test
below runs with `make test`.
"""


def load() -> dict[str, list[dict[str, Any]]]:
    """The rows: "feature" and "defect"."""
    return tomllib.loads(TABLE.read_text("utf-8"))


@cache
def tests() -> dict[str, dict[Path, list[str]]]:
    """Name of a test file → each file of that name below tests/, and its test functions."""
    found: dict[str, dict[Path, list[str]]] = {}
    for file in sorted((ROOT / "tests").rglob("test_*.py")):
        functions = [node.name for node in ast.parse(file.read_text("utf-8")).body if isinstance(node, ast.FunctionDef)]
        found.setdefault(file.name, {})[file] = [name for name in functions if name.startswith("test_")]
    return found


def fault(shown: str) -> str | None:
    """What is wrong with a reference to a test or a benchmark, or None. Command lines are not checked."""
    if shown.startswith("benchmarks/"):
        return None if (ROOT / shown).exists() else f"no file {shown}"
    if not shown.startswith("test_"):
        return None
    name, _, function = shown.partition("::")
    files = tests().get(name, {})
    holders = [file for file, functions in files.items() if not function or function in functions]
    if len(holders) == 1:
        return None
    if len(holders) > 1:
        return f"{shown} is in several folders: {', '.join(str(file.relative_to(ROOT)) for file in holders)}"
    near = get_close_matches(function, [one for functions in files.values() for one in functions], 1, 0.4)
    hint = f"; perhaps {near[0]}" if near else ""
    return f"no test {shown}{hint}" if files else f"no file {name}"


def link(shown: str) -> str:
    """A reference as Markdown."""
    if shown.startswith("benchmarks/"):
        return f"[{Path(shown).name}](../{shown})"
    if not shown.startswith("test_"):
        return f"`{shown}`"
    name, _, function = shown.partition("::")
    (file,) = [file for file, functions in tests()[name].items() if not function or function in functions]
    words = function.removeprefix("test_").replace("_", " ") if function else f"all of {file.stem}"
    return f"[{words}](../{file.relative_to(ROOT).as_posix()})"


def table(kind: str, rows: list[dict[str, Any]]) -> Iterator[str]:
    """Lines of one table."""
    yield f"| {kind} | status | shown by |"
    yield "| --- | --- | --- |"
    for row in rows:
        note = f" *{row['note']}*" if "note" in row else ""
        yield f"| {row[kind]}.{note} | {row['status']} | {'; '.join(map(link, row['shown']))} |"


def page() -> str:
    """The whole page."""
    rows = load()
    lines = [INTRODUCTION, "## Features", ""]
    works, partly, missing = (
        sum(row["status"] == status for row in rows["feature"]) for status in ("works", "partly", "missing")
    )
    lines += [f"Of {len(rows['feature'])} features {works} work, {partly} partly, and {missing} are missing.", ""]
    for area, group in groupby(rows["feature"], lambda row: str(row["area"])):
        lines += [f"### {area}", "", *table("feature", list(group)), ""]
    lines += ["## Defects of the earlier systems", ""]
    lines += ["Found in their code or their issue trackers. Each has a test that fails where it is repeated.", ""]
    lines += [*table("defect", rows["defect"]), ""]
    return "\n".join(lines)


if __name__ == "__main__":
    print(page(), end="")
