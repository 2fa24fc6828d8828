"""docs/debugging.md: its brain plays."""

from collections.abc import Callable
from pathlib import Path

import pytest

from robot_agent.brain_loader import load_brain
from robot_agent.contract import Briefing
from support.messages import make_setup, make_sight

Fenced = Callable[[str, str], list[str]]


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "debugging.md").read_text()


def test_its_brain_is_slower_while_it_holds_the_ball(
    page: str, fenced: Fenced, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = next(piece for piece in fenced(page, "python") if "class Careful" in piece)
    (tmp_path / "my_team_of_the_page.py").write_text(source)
    monkeypatch.syspath_prepend(tmp_path)
    careful, simple = (
        load_brain(spec, Briefing.of("cyan3", make_setup()))
        for spec in ("my_team_of_the_page:Careful", "robot_agent.teams.simple:Simple")
    )
    sight = make_sight(robot="cyan3", holding=True)
    assert careful.act(sight).drive.vx == 0.5 * simple.act(sight).drive.vx != 0.0
