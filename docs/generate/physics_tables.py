"""Writes the tables of parameters into docs/physics.md: `python docs/generate/physics_tables.py`.

Between `<!-- table SECTION -->` and `<!-- end -->` it writes each number of that section of a profile, with its unit,
its values in the profiles `msl` and `paper`, and its meaning.
"""

import re
from pathlib import Path
from typing import Any

from schemas.config.profile import load_profile
from schemas.config.quantity import Quantity, meanings
from schemas.config.sections import SECTIONS

PAGE = Path(__file__).parents[1] / "physics.md"
SHOWN = ("msl", "paper")
_BLOCK = re.compile(r"<!-- table (\w+) -->\n.*?<!-- end -->", re.DOTALL)


def _value(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def table(section: str) -> str:
    """The table of one section."""
    profiles = [load_profile(name) for name in SHOWN]
    lines = [f"| `{section}` | unit | {' | '.join(SHOWN)} | |", "| --- | --- | --- | --- | --- |"]
    for name, meaning in meanings(SECTIONS[section]).items():
        values = [_value(getattr(getattr(profile, section), name)) for profile in profiles]
        unit = meaning.unit if isinstance(meaning, Quantity) else "word"
        lines.append(f"| `{name}` | {unit} | {' | '.join(values)} | {meaning.meaning} |")
    return "\n".join(lines)


def filled(text: str) -> str:
    """The text with all tables filled in from the profiles."""
    return _BLOCK.sub(lambda block: f"<!-- table {block[1]} -->\n{table(block[1])}\n<!-- end -->", text)


if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text("utf-8")), "utf-8")
