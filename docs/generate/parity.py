"""Writes docs/parity.md from docs/generate/parity.toml: `python docs/generate/parity.py > docs/parity.md`."""

import ast
import tomllib
from collections.abc import Iterator
from difflib import get_close_matches
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
TABLE = Path(__file__).parent / "parity.toml"
INTRODUCTION = """\
# Compared with the simulation system of the NuBot team

<!-- Written by `python docs/generate/parity.py > docs/parity.md`; edit docs/generate/parity.toml. -->

Touchline began as a replacement for the simulation of the NuBot team, which runs on ROS and Gazebo. This page lists
what that simulation, its successor and the tools of its league offer, and whether Touchline offers it:

* **The paper**: W. Yao, W. Dai, J. Xiao, H. Lu, Z. Zheng, *A Simulation System Based on ROS and Gazebo for RoboCup
  Middle Size League* (2015), and its code, nubot-nudt/single_nubot_gazebo.
* **simatch**: its successor for two teams, with coach and automatic referee (nubot-nudt/gazebo_visual and
  nubot-nudt/simatch).
* **The league**: the referee box of the Middle Size League, its rule books, its protocol for mixed teams, and the
  requirements that it wrote down for a simulator of its own (RoboCup-MSL/RefBox and RoboCup-MSL/MSL-Simulator).

The features were collected from the text and the equations of the paper, from the code and the open issues of these
repositories, and from the rule books. The column *found in* names the source; *simatch lacks it* stands for a gap that
its authors or users name, *league wants it* for a requirement that no tool of the league meets.

A feature **works** if a test shows it with its effect, **partly** if something named in italics is missing, and is
**missing** if Touchline does not have it. The last column links the tests; every one runs with `make test`. Italics say
what is different here. `touchline match matches/paper.toml` plays on the pitch of the paper with its robots, noise and
physics step.
"""


def load() -> dict[str, list[dict[str, Any]]]:
    """The rows: "feature" and "defect"."""
    return tomllib.loads(TABLE.read_text("utf-8"))


@cache
def tests() -> dict[str, dict[Path, list[str]]]:
    """Name of a test file → each file of that name below tests/, and its test functions."""
    found: dict[str, dict[Path, list[str]]] = {}
    for file in sorted((ROOT / "tests").rglob("test_*.py")):
        body = ast.parse(file.read_text("utf-8")).body
        functions = [node.name for node in body if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
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


def feature_table(rows: list[tuple[int, dict[str, Any]]]) -> Iterator[str]:
    """Lines of a table of features, each with its number."""
    yield "| | feature | found in | status | shown by |"
    yield "| --- | --- | --- | --- | --- |"
    for number, row in rows:
        shown = "; ".join(map(link, row["shown"])) or "–"
        yield f"| {number} | {_text(row, 'feature')} | {', '.join(row['from'])} | {row['status']} | {shown} |"


def defect_table(rows: list[dict[str, Any]]) -> Iterator[str]:
    """Lines of the table of defects."""
    yield "| defect | status | shown by |"
    yield "| --- | --- | --- |"
    for row in rows:
        yield f"| {_text(row, 'defect')} | {row['status']} | {'; '.join(map(link, row['shown']))} |"


def _text(row: dict[str, Any], kind: str) -> str:
    """A feature or a defect, with its note in italics."""
    return f"{row[kind]}.{' *' + row['note'] + '*' if 'note' in row else ''}"


def page() -> str:
    """The whole page."""
    rows = load()
    lines = [INTRODUCTION, "## Features", ""]
    works, partly, missing = (
        sum(row["status"] == status for row in rows["feature"]) for status in ("works", "partly", "missing")
    )
    lines += [f"Of {len(rows['feature'])} features {works} work, {partly} partly, and {missing} are missing.", ""]
    for area, group in groupby(enumerate(rows["feature"], 1), lambda numbered: str(numbered[1]["area"])):
        lines += [f"### {area}", "", *feature_table(list(group)), ""]
    lines += ["## Defects of the earlier systems", ""]
    lines += ["Found in their code or their issue trackers. Each has a test that fails where it is repeated.", ""]
    lines += [*defect_table(rows["defect"]), ""]
    return "\n".join(lines)


if __name__ == "__main__":
    print(page(), end="")
