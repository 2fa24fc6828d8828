"""The plugin in a user's pytest."""

import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).parents[3]
BRAIN = """
from touchline import Command, Drive


class Forward:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), dribble=True)
"""
TESTS = """
def test_gets_the_ball(play):
    runs = play.over("lob_practice", seeds=range(3), cyan2="my_brain:Forward", seconds=1)
    runs.at_least(2, lambda facts: facts.first("touch:cyan2").time < 1)


def test_scores(play):
    play.over("lob_practice", seeds=range(3), cyan2="my_brain:Forward", seconds=1).at_least(
        3, lambda facts: facts.has("goal:cyan")
    )
"""


def test_pytest_finds_the_plugin_by_its_entry_point() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    plugin = import_module(project["entry-points"]["pytest11"]["touchline"])
    assert hasattr(plugin, "play")


def test_the_plugin_costs_a_user_without_such_tests_next_to_nothing() -> None:
    heavy = "{'pybullet', 'numpy', 'pydantic', 'msgspec', 'zenoh', 'schemas', 'sim_host'}"
    code = "import pytest, sys; before = set(sys.modules); import touchline.testing.plugin; "
    code += f"print(sorted({heavy} & (set(sys.modules) - before)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stdout == "[]\n"


def test_a_users_tests_find_the_brain_beside_them_and_fail_with_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "my_brain.py").write_text(BRAIN)
    (tmp_path / "conftest.py").write_text("from touchline.testing.plugin import play\n")
    (tmp_path / "test_brain.py").write_text(TESTS)
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", str(tmp_path), str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT)
    assert "1 failed, 1 passed" in done.stdout, done.stdout
    assert "0 of 3 seeds, at least 3 wanted; not these:" in done.stdout
    assert "lob_practice, seed 0: " in done.stdout
    assert "runs.py" not in done.stdout  # the message, and not how it came about
