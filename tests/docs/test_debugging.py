"""docs/debugging.md: its brains play and draw, and its bounds are those of the code."""

import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robot_agent.sdk.contract import Briefing
from schemas.config.match_config import load_match
from schemas.messages import debug
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from support.messages import make_setup, make_sight
from touchline.play.play_match import InProcessMatch
from touchline.team.new_team import make_team

PAGE = (Path(__file__).parents[2] / "docs" / "debugging.md").read_text()
SECTION = PAGE.partition("## Draw and plot")[2].partition("\n## ")[0]


@pytest.fixture
def brains(fenced: Callable[[str, str], list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What the code of the page defines, beside a new team."""
    monkeypatch.delitem(sys.modules, "my_team", raising=False)
    others = [path for path in sys.path if not any(Path(path).glob("my_team*"))]  # of brains that were loaded before
    monkeypatch.setattr(sys, "path", others)
    monkeypatch.syspath_prepend(make_team("my_team", tmp_path))
    names: dict[str, Any] = {}
    for piece in fenced(PAGE, "python"):
        if re.search(r"class (Careful|Chaser)", piece):
            exec(piece, names)  # the documents are ours
    return names


def test_its_brain_is_slower_while_it_holds_the_ball(brains: dict[str, Any]) -> None:
    briefing, sight = Briefing.of("cyan3", make_setup()), make_sight(robot="cyan3", holding=True)
    careful, team = (brain(briefing).act(sight) for brain in (brains["Careful"], brains["MyTeam"]))
    assert careful.drive.vx == 0.5 * team.drive.vx != 0.0


@pytest.mark.slow
def test_its_table_is_that_of_the_match_that_it_names(brains: dict[str, Any], tmp_path: Path) -> None:
    duration, seed = map(int, re.search(r"--duration (\d+) --seed (\d+)", PAGE).groups())
    robot = re.search(r"--agent (\w+)=careful", PAGE)[1]
    shown = re.search(r"^ +(\d+) .* drive\.vx +(\S+) m/s +(\S+) m/s$", PAGE, re.MULTILINE).groups()
    folder = tmp_path / "my_team"
    match = InProcessMatch(load_match(folder / "match.toml", {"seed": seed, "duration": duration}), brain_folder=folder)
    careful = brains["Careful"](Briefing.of(robot, match.simulation.setup()))
    recorded = new = Drive()
    while recorded == new:
        sight = match.simulation.now.sights.perceived[robot].own_copy()
        match.step()
        recorded, new = match.commands[robot].drive, careful.act(sight).drive
    match.close()
    assert (str(sight.tick), f"{recorded.vx:.3f}", f"{new.vx:.3f}") == shown


def test_the_example_plays_and_draws(brains: dict[str, Any]) -> None:
    match = InProcessMatch(load_match(None, {"seed": 1, "duration": 5.0}))
    brain = brains["Chaser"](Briefing.of("cyan2", match.simulation.setup()))
    drawn = []
    for _ in range(20):
        command = brain.act(Sight.decode(match.step().sights["cyan2"]))
        assert isinstance(command, Command) and command.debug is not None
        drawn.append(command.debug)
    match.simulation.close()
    assert any(shown.lines and "distance_to_ball" in shown.values for shown in drawn)


def test_bounds_and_colours_on_the_page_are_those_of_the_code() -> None:
    bounds = SECTION.partition("**Bounds.**")[2].partition("\n\n")[0]
    for bound in (debug.MAX_VALUES, debug.MAX_SHAPES, debug.MAX_CORNERS, debug.MAX_BYTES):
        assert re.search(rf"\b{bound}\b", bounds)
    assert ", ".join(debug.COLOURS) in " ".join(SECTION.split())
