"""Plays each shipped task with its baseline brain, and writes the table of docs/tasks.md.

python docs/generate/task_table.py --episodes 200
python docs/generate/task_table.py --episodes 200 --tasks coverage formation
"""

import argparse
import sys
from pathlib import Path

from touchline.matches.engine.play_list import play_list
from touchline.matches.task.episodes import TaskResult, episodes_of, result_of
from touchline.matches.task.task import Task, load_task, shipped_tasks

PAGE = Path(__file__).parents[1] / "tasks.md"
PICTURES = "images/tasks"
_MARK = "<!-- tasks -->\n"
_HEAD = "| task | who | s | score | what it is |\n| --- | --- | --- | --- | --- |\n"


def row_of(task: Task, score: str) -> str:
    """The row of a task in the table."""
    who = f"{len(task.robots)} {'robot' if len(task.robots) == 1 else 'robots'}"
    others = len(task.config.robots(task.side.opponent))
    who += f" against {others}" if others else ""
    cells = (f"[`{task.name}`]({PICTURES}/{task.name}.gif)", who, f"{task.config.duration:g}", score, task.description)
    return f"| {' | '.join(cells)} |"


def score_text(result: TaskResult) -> str:
    """A mean with its interval and unit."""
    score = result.score
    assert score is not None
    interval = "" if score.low is None else f" ({score.low:.3g} to {score.high:.3g})"
    return f"{score.value:.3g}{interval} {result.unit}".strip()


def scores_in(page: str) -> dict[str, str]:
    """Task → its score as the page has it."""
    cells = [line.split(" | ") for line in rows_in(page)]
    return {row[0].partition("`")[2].partition("`")[0]: row[3] for row in cells}


def rows_in(page: str) -> list[str]:
    """The rows of the page's table."""
    return page.partition(_MARK)[2].partition("\n\n")[0].splitlines()[2:]


def main() -> int:
    """Play the tasks and write the table; returns 1 if an episode failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=200)
    parser.add_argument("--tasks", nargs="+", choices=shipped_tasks(), default=shipped_tasks())
    parser.add_argument("--jobs", type=int, default=0, help="episodes at a time; 0 for one per core")
    options = parser.parse_args()
    failed = 0
    for name in options.tasks:
        task = load_task(name)
        planned = episodes_of(task, range(1, options.episodes + 1))
        outcomes = play_list(planned, options.jobs, name, lambda one, _: one.label, json=False).outcomes
        result = result_of(task, planned, outcomes)
        failed += len(result.failed)
        page = PAGE.read_text("utf-8")
        scores = scores_in(page) | {name: score_text(result)}
        rows = [row_of(load_task(each), scores.get(each, "")) for each in shipped_tasks()]
        before, _, after = page.partition(_MARK)
        rest = after[after.index("\n\n") :]
        PAGE.write_text(before + _MARK + _HEAD + "\n".join(rows) + rest, "utf-8")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
