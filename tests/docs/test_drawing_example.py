"""The example of docs/debugging.md that draws is a brain, and draws."""

import re
from pathlib import Path

import pytest

from robot_agent.contract import Briefing
from schemas.config.match_config import load_match
from schemas.messages import debug
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from touchline.play import InProcessMatch

PAGE = (Path(__file__).parents[2] / "docs" / "debugging.md").read_text()
SECTION = PAGE.partition("## Draw and plot")[2].partition("\n## ")[0]


def test_the_example_plays_and_draws() -> None:
    found = re.search(r"```python\n(.*?)```", SECTION, re.DOTALL)
    assert found is not None
    names: dict[str, type] = {}
    exec(found[1], names)
    match = InProcessMatch(load_match(None, {"seed": 1, "duration": 5.0}))
    brain = names["Chaser"](Briefing.of("cyan2", match.simulation.setup()))
    drawn = []
    for _ in range(20):
        command = brain.act(Sight.decode(match.step().sights["cyan2"]))
        assert isinstance(command, Command) and command.debug is not None
        drawn.append(command.debug)
    match.simulation.close()
    assert any(shown.lines and "distance to the ball" in shown.values for shown in drawn)


@pytest.mark.parametrize("bound", [debug.MAX_VALUES, debug.MAX_SHAPES, debug.MAX_CORNERS, debug.MAX_BYTES])
def test_the_bounds_on_the_page_are_those_of_the_code(bound: int) -> None:
    assert re.search(rf"\b{bound}\b", SECTION.partition("**Bounds.**")[2].partition("\n\n")[0])


def test_the_colours_on_the_page_are_those_of_the_code() -> None:
    assert ", ".join(debug.COLOURS) in " ".join(SECTION.split())
