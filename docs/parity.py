"""Writes docs/parity.md: which test shows which feature of the seed, and which defect of it is kept out.

`python docs/parity.py > docs/parity.md`. The rows are found in the docstrings of the tests, which name them as
"reference 13, row 9" and "reference 14, defect 4".
"""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]

ROWS = {
    1: "velocity interface in the body frame",
    2: "mass, inertia and size of the robots",
    3: "speed limits that keep the direction",
    4: "acceleration limits in the body frame",
    5: "hold condition by distance and total cone",
    6: "dribbling by pose and by velocity",
    7: "a ball in the air is refused, with the reason",
    8: "ground kick at its exit speed",
    9: "lob through the point under the bar",
    10: "lob with fixed loft",
    11: "rolling resistance",
    12: "noise on what is perceived",
    13: "truth of each body, and of all at one tick",
    14: "range, occlusion and latency",
    15: "polar ball and obstacles, in SI",
    16: "keys by team and robot",
    17: "one command record; refusals with reason",
    18: "watchdog for commands that fail to come",
    19: "the paper's state machine, state by state",
    21: "live parameters",
    22: "reset with a new episode",
    23: "2 to 100 robots",
    24: "two sides with the same code",
    29: "each coach's command reaches every robot",
    30: "the coach record, in SI and acknowledged",
    31: "match modes and test modes by number, both ways",
    32: "the coach's window: controls, panels, stop by the space bar",
    33: "base station at a league's referee box",
    34: "referee box for team software",
    35: "world state in the league's schema",
    37: "the referee's deeds by hand",
    39: "last touch and possession",
    40: "a fair scrum",
    41: "pitches of either year",
    42: "start poses, ball spots, scenes",
    43: "driving by hand",
    44: "stuck flag of each robot",
    45: "lifted and tipped robots stand up",
    51: "spectators who only watch, coaches of their own side alone",
}
"""Features among those of the seed, in our words."""
DEFECTS = {
    1: "an acceleration limit that limited nothing",
    2: "top speed that depended on the compass",
    3: "one noisy sample in 11 where one in 100 was meant",
    4: "physics that decided from noisy data",
    5: "one stuck flag for all robots",
    6: "metres among centimetres",
    7: "a stop that hears one side's coach alone",
    8: "no arbitration; the ball carried through opponents",
    9: "no watchdog",
    10: "kicks kept for later",
    11: "kick modes as signs, which were swapped",
    12: "lobs without a limit",
    13: "robots counted with one digit, five at most",
    14: "state taken from the bus instead of the engine",
    15: "a step that the code took for constant",
    18: "teams told apart by their address",
}
"""Defects of the seed, in our words."""


def words_of(docstring: str) -> Iterator[tuple[str, int]]:
    """("row", 9) or ("defect", 4) for each that a docstring names."""
    for kind, numbers in re.findall(r"(row|defect)s? ((?:\d+(?:, | and )?)+)", docstring, re.IGNORECASE):
        for number in re.findall(r"\d+", numbers):
            yield kind.lower(), int(number)


def named() -> dict[tuple[str, int], list[tuple[str, str]]]:
    """("row", 9) → file and name of each test that names it, or of all tests of a file that does."""
    found = defaultdict(list)
    for file in sorted((ROOT / "tests").rglob("test_*.py")):
        tree = ast.parse(file.read_text("utf-8"))
        tests = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")]
        whole = [(f"all of {file.stem}", tree)] if tests else []
        for name, node in [*whole, *((test.name, test) for test in tests)]:
            for which in dict.fromkeys(words_of(ast.get_docstring(node) or "")):
                found[which].append((file.relative_to(ROOT).as_posix(), name))
    return dict(found)


def table(kind: str, meanings: dict[int, str]) -> Iterator[str]:
    """Lines of one table."""
    tests = named()
    yield f"| {kind} | what | shown by |"
    yield "| --- | --- | --- |"
    for number, meaning in meanings.items():
        shown = [
            f"[{test.removeprefix('test_').replace('_', ' ')}](../{file})"
            for file, test in tests.get((kind, number), [])
        ]
        yield f"| {number} | {meaning} | {'; '.join(shown)} |"


def page() -> str:
    """The whole page."""
    return "\n".join(
        [
            "# What the seed could do, and what it did wrong",
            "",
            "The seed is the paper's simulator and those that grew out of it. For each of its features and defects",
            "that concern the world: the tests that show it here. Numbers are those of the project's reference.",
            "Written by `docs/parity.py`.",
            "",
            "## Features",
            "",
            *table("row", ROWS),
            "",
            "## Defects",
            "",
            *table("defect", DEFECTS),
            "",
        ]
    )


if __name__ == "__main__":
    print(page(), end="")
