"""`touchline task`: tasks for teams of robots, and the score of a brain over many seeds."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from runtime.process.clock import WallClock
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.launch.terminal.aligned import aligned, counted
from touchline.launch.terminal.json_text import json_text
from touchline.matches.series.seeds import seeds_of

if TYPE_CHECKING:
    from touchline.matches.engine.failures import Failures
    from touchline.matches.engine.outcome import Outcome
    from touchline.matches.engine.planned_match import PlannedMatch
    from touchline.matches.task.episodes import TaskResult
    from touchline.matches.task.task import Task

DEFAULT_SEEDS = "1-20"
app = typer.Typer(
    no_args_is_help=True,
    help="Tasks for teams of robots, smaller than a match and beyond soccer: list them, and score a brain.\n\n"
    "Example: touchline task run keepaway_3v2 --episodes 50",
)


@app.command("list")
def list_tasks(json: options.Json = False) -> None:
    """List the tasks that ship, with their robots and the unit of their score.

    Example: touchline task list
    """
    from touchline.matches.task.task import load_task, shipped_tasks

    tasks = [load_task(name) for name in shipped_tasks()]
    if json:
        typer.echo(json_text({"tasks": [_described(task) for task in tasks]}))
        return
    rows = [(one["task"], one["game"], counted(one["robots"], "robot"), one["unit"]) for one in map(_described, tasks)]
    for line, task in zip(aligned(rows), tasks, strict=True):
        typer.echo(f"{line}  {task.description}")


@app.command("run")
def run(
    task: Annotated[str, typer.Argument(metavar="TASK", help="A task by name, or the path of its match file.")],
    brain: Annotated[
        str | None,
        typer.Option(
            metavar="TEAM", help="Who does it: a shipped team, module:Class or policy:FILE; by default the baseline."
        ),
    ] = None,
    episodes: Annotated[int | None, typer.Option(min=1, help="Number of episodes, with the seeds from 1 on.")] = None,
    seeds: Annotated[str | None, typer.Option(metavar="SEEDS", help=f"Seeds; by default {DEFAULT_SEEDS}.")] = None,
    change: options.Changes = None,
    at_least: Annotated[
        float | None, typer.Option(metavar="SCORE", help="Exit with status 1 if the mean score is less.")
    ] = None,
    failures: options.Failures = 0,
    below: Annotated[
        float | None, typer.Option(metavar="SCORE", help="With --failures: an episode with this score is no failure.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder of these recordings; by default a new one in runs/.")
    ] = None,
    show: Annotated[
        bool, typer.Option("--show", help="With --failures: then show the worst one, as touchline replay --web does.")
    ] = False,
    jobs: options.Jobs = 0,
    json: options.Json = False,
) -> None:
    """Play a task from many seeds in parallel, without a network, and print its score with an interval of 95 %.

    Each seed has another start and other noise; equal seeds give equal episodes. If a brain raises, its episode counts
    as not played, and the exit status is 1.

    Example: touchline task run keepaway_3v2 --brain simple --episodes 50 --failures 5
    """
    options.need_statistics()
    from touchline.launch.run_folder import new_run_folder
    from touchline.matches.engine.failures import keep_failures
    from touchline.matches.engine.play_list import play_list
    from touchline.matches.task.episodes import episodes_of, result_of
    from touchline.matches.task.task import load_task

    options.check_numbers(at_least=at_least, below=below)
    if not failures and (show or (below, out) != (None, None)):
        raise TouchlineError("--below, --out and --show are about the recordings of --failures; give that, too")
    if out is not None and any(out.glob("*.mcap")):
        raise TouchlineError(f"{out}: has recordings; give another folder with --out, or move that one away")
    loaded = load_task(task, brain_of(brain) if brain is not None else None, options.settings_of(change or []))
    planned = episodes_of(loaded, _seeds(episodes, seeds))
    played = play_list(planned, jobs, loaded.name, _sentence, json=json)
    result = result_of(loaded, planned, played.outcomes)
    kept = None
    if failures and not played.is_interrupted:
        folder = out or new_run_folder(f"{loaded.name}-failures", WallClock())
        worth = (planned, played.outcomes, lambda one: one.value)
        kept = keep_failures(*worth, failures, folder, jobs, below, json=json)
    _print(loaded, result, kept, json=json)
    if played.is_interrupted or (kept is not None and kept.is_interrupted):
        raise KeyboardInterrupt
    has_failed = _is_below(result, at_least) or result.failed or (kept is not None and kept.missing)
    if show and kept is not None and kept.kept:
        _show(kept.kept[0].recording)
    if has_failed:
        raise typer.Exit(FAILED)


def _show(recording: Path) -> None:
    """Do as `touchline replay RECORDING --web`."""
    from touchline.commands.replay import replay

    command = typer.Typer(add_completion=False)
    command.command()(replay)
    command([str(recording), "--web"], standalone_mode=False)


def _seeds(episodes: int | None, seeds: str | None) -> list[int]:
    if episodes is not None and seeds is not None:
        raise TouchlineError(f"--episodes {episodes} and --seeds {seeds} are both given; leave one out")
    return list(range(1, episodes + 1)) if episodes is not None else seeds_of(seeds or DEFAULT_SEEDS)


def _described(task: "Task") -> dict[str, Any]:
    """What the list has of a task."""
    return {
        "task": task.name,
        "game": task.config.game.value,
        "robots": len(task.robots),
        "unit": task.unit,
        "seconds": task.config.duration,
        "description": task.description,
    }


def _sentence(planned: "PlannedMatch", outcome: "Outcome") -> str:
    score = getattr(outcome, "value", None)
    said = f"{score:.6g}" if score is not None else f"not played: {getattr(outcome, 'reason', '')}"
    return f"{planned.label}: {said}"


def _print(task: "Task", result: "TaskResult", kept: "Failures | None", *, json: bool) -> None:
    if json:
        typer.echo(json_text({"result": result, "failures": kept}))
        return
    for failed in result.failed:
        typer.echo(f"seed {failed.seed}: not played: {failed.reason}", err=True)
    score = result.score
    if score is not None and result.time is not None:
        unit = f" {task.unit}".rstrip()
        interval = "" if score.low is None else f" ({score.low:.4g} to {score.high:.4g})"
        line = f"{task.name}: {score.value:.4g}{unit}{interval} in {counted(len(result.episodes), 'episode')}"
        typer.echo(f"{line}; from {result.least:.4g} to {result.most:.4g}, {result.time:.1f} s each")
    if len(result.episodes) + len(result.failed) < result.planned:
        typer.echo(f"{result.planned - len(result.episodes) - len(result.failed)} not played")
    for line in kept.lines if kept is not None else []:
        typer.echo(line)


def _is_below(result: "TaskResult", bound: float | None) -> bool:
    """Whether the mean score is less than the bound; says so."""
    if bound is None or (result.score is not None and result.score.value >= bound):
        return False
    score = f"{result.score.value:.4g}" if result.score is not None else "unknown"
    typer.echo(f"touchline: the score is {score}, less than --at-least {bound:g}", err=True)
    return True
