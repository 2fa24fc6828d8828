"""docs/team.md: its code plays, its tables are complete, and its skills are those that users import."""

import dataclasses
import inspect
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_type_hints

import msgspec
import pytest

from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.world_model import WorldBelief
from schemas.config.match_config import load_match
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.side import Side
from touchline import skills
from touchline.play.play_match import InProcessMatch

PLAYS = 250
"""Ticks: the kick-off, and some play."""


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "team.md").read_text("utf-8")


@pytest.fixture(scope="module")
def brains(page: str, fenced: Callable[[str, str], list[str]]) -> dict[str, Any]:
    """The classes that the code of the page defines."""
    names: dict[str, Any] = {}
    for piece in fenced(page, "python"):
        exec(piece, names)  # the documents are ours
    return {name: one for name, one in names.items() if inspect.isclass(one) and one.__module__ == "builtins"}


def rows(page: str, heading: str) -> list[str]:
    """The names in the first column of the first table below a heading."""
    table = re.search(r"^#+ " + re.escape(heading) + r".*?^((?:\|[^\n]*\n)+)", page, re.DOTALL | re.MULTILINE)
    assert table is not None
    first = (row.split("|")[1] for row in table[1].splitlines()[2:])
    return [name for cell in first for name in re.findall(r"`([a-z_]+)", cell)]


@pytest.mark.parametrize("name", ["Chaser", "Nearest", "Shown"])
def test_its_brains_play_and_reach_the_ball(brains: dict[str, Any], name: str) -> None:
    config = load_match(None, {"duration": 60.0, "teams.cyan.size": 3, "teams.magenta.size": 1})
    match = InProcessMatch(config)
    setup = match.simulation.setup()
    for robot in config.robots(Side.CYAN):
        match.brains[robot] = brains[name](Briefing.of(robot, setup))
    touched: set[str] = set()
    for _ in range(PLAYS):
        touched.update(match.step().world.get("touches", ()))
    match.simulation.close()
    assert any(robot.startswith("cyan") for robot in touched)


@pytest.mark.parametrize(
    ("heading", "kind"), [("Sight: what a robot perceives", Sight), ("Command: what a robot does", Command)]
)
def test_its_tables_name_every_field_of_a_message(page: str, heading: str, kind: type) -> None:
    fields = {field.name for field in msgspec.structs.fields(kind)}
    unmentioned = {"version", "robot", "side", "obstacles_age", "refuses_order"}  # protocol.md has them
    assert fields - unmentioned <= set(rows(page, heading)) <= fields


def test_its_tables_name_every_field_of_briefing_and_belief(page: str) -> None:
    assert set(rows(page, "Briefing: what a robot knows")) == {field.name for field in dataclasses.fields(Briefing)}
    assert set(rows(page, "The world model")) - {"others"} == set(get_type_hints(WorldBelief))


def test_its_skills_have_the_arguments_that_it_shows(page: str) -> None:
    shown = re.findall(r"^\| `([a-z_]+)\((.*?)\) →", page, re.MULTILINE)
    assert len(shown) > 15
    for name, arguments in shown:
        names = [argument.split("=")[0] for argument in arguments.split(", ")]
        assert list(inspect.signature(getattr(skills, name)).parameters) == names, name


def test_every_skill_that_users_import_is_on_the_page(page: str) -> None:
    assert [name for name in skills.__all__ if name not in page] == []


def test_every_picture_is_there_and_is_small(page: str, root: Path) -> None:
    pictures = re.findall(r"\((images/skill_\w+\.png)\)", page)
    assert len(pictures) > 10
    assert all((root / "docs" / picture).stat().st_size < 30_000 for picture in pictures)
