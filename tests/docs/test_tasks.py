"""docs/tasks.md: its table is that of the tasks that ship, and its own task is one that can be played."""

import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

import task_table
from support.imports import forgotten_imports
from touchline.commands.cli.command_line import app
from touchline.matches.task.task import load_task, shipped_tasks

Fenced = Callable[[str, str], list[str]]


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "tasks.md").read_text("utf-8")


def test_the_table_has_a_row_for_each_task_with_its_score(page: str) -> None:
    scores = task_table.scores_in(page)
    assert task_table.rows_in(page) == [task_table.row_of(load_task(name), scores[name]) for name in shipped_tasks()]
    assert [
        name for name, score in scores.items() if not re.match(r"-?[\d.e-]+ \(-?[\d.e-]+ to -?[\d.e-]+\)", score)
    ] == []


@pytest.mark.slow
@pytest.mark.processes
def test_the_page_s_own_task_has_at_most_60_lines_and_its_commands_play_it(
    page: str, fenced: Fenced, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (match_file,), (module,) = fenced(page, "toml"), fenced(page, "python")
    (tmp_path / "tug.toml").write_text(match_file)
    (tmp_path / "tug.py").write_text(module)
    assert len(f"{match_file}{module}".splitlines()) <= 60
    monkeypatch.chdir(tmp_path)
    commands = [shlex.split(line)[1:] for line in fenced(page, "sh")[1].splitlines()]
    assert [command[0] for command in commands] == ["task", "match", "verify"]
    commands[0][-1:] = ["2", "--jobs", "1", "--at-least", "1"]
    commands[1] += ["--duration", "2", "--listen", "tcp/127.0.0.1:0"]
    with forgotten_imports(tmp_path):
        results = [CliRunner().invoke(app, command) for command in commands]
    assert [result.exit_code for result in results] == [0, 0, 0], "".join(result.output for result in results)
    assert re.match(r"tug: [\d.]+ m \(.* in 2 episodes; from ", results[0].stdout)
    assert results[2].stdout.startswith("identical, 101 ticks\n")
