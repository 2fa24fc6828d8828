"""docs/testing.md: its tests pass, its scene is a drill, and its tables are complete."""

import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from schemas.config.scene import load_scene, shipped_scenes
from schemas.config.soccer.drill import OCCURRENCES
from touchline.testing import Facts


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "testing.md").read_text("utf-8")


def table(page: str, mark: str) -> list[list[str]]:
    """The cells of the rows of a table below a mark."""
    found = re.search(rf"<!-- {mark} -->\n((?:\|[^\n]*\n)+)", page)
    assert found is not None
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in found[1].splitlines()[2:]]


def test_its_tests_pass_with_the_first_brain(
    root: Path, page: str, fenced: Callable[[str, str], list[str]], tmp_path: Path
) -> None:
    shutil.copy(root / "examples" / "first_brain.py", tmp_path)
    (tmp_path / "conftest.py").write_text("from touchline.testing.plugin import play\n")
    (tmp_path / "test_page.py").write_text("\n\n".join(fenced(page, "python")))
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", str(tmp_path), str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, cwd=root)
    assert "3 passed" in done.stdout, done.stdout


def test_its_scene_is_a_drill(page: str, fenced: Callable[[str, str], list[str]], tmp_path: Path) -> None:
    (text,) = fenced(page, "toml")
    path = tmp_path / "fetch.toml"
    path.write_text(text)
    assert load_scene(str(path)).drill is not None


def test_all_drills_are_listed_with_their_time(page: str) -> None:
    scenes = [scene for scene in map(load_scene, shipped_scenes()) if scene.drill is not None]
    assert table(page, "drills") == [
        [f"`{scene.name}`", scene.description, f"{scene.drill.seconds:g}"] for scene in scenes if scene.drill
    ]


def test_all_occurrences_are_listed(page: str) -> None:
    assert table(page, "occurrences") == [[f"`{name}`", meaning] for name, meaning in OCCURRENCES.items()]


def test_members_of_facts_are_those_that_it_has(page: str) -> None:
    section = page[page.index("### What `Facts` knows") : page.index("`Runs`, which")]
    cells = [row.split("|")[1] for row in section.splitlines() if row.startswith("| `")]
    named = {name for cell in cells for name in re.findall(r"`([a-z_]+)", cell)}
    public = {name for name in {*dir(Facts), *Facts.__annotations__} if not name.startswith("_")}
    assert named == public - {"scene", "seed", "seconds", "pitch", "occurrences"}
