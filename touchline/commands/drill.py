"""`touchline drill`: a scene played from many seeds, and its score with an interval."""

import dataclasses
import json as json_text
import signal
from collections import Counter
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.errors import TouchlineError
from touchline.cli import options
from touchline.cli.errors import FAILED
from touchline.cli.interrupts import sigterm_interrupts

if TYPE_CHECKING:
    from touchline.matches.drill.play_drill import DrillRow, PlannedDrill


def drill(
    scene: Annotated[str, typer.Argument(metavar="SCENE", help="A scene with a table `drill`, by name or path.")],
    brain: Annotated[
        str, typer.Option(metavar="TEAM", help="Who practises: the name of a shipped team, or module:Class.")
    ] = "simple",
    opponents: Annotated[
        str, typer.Option(metavar="TEAM", help="The team of the other side's robots, if the scene has any.")
    ] = "simple",
    seeds: Annotated[str, typer.Option(metavar="SEEDS", help="A range and single seeds: 1-50, or 1-10,31.")] = "1-20",
    profile: options.Profile = None,
    rules: options.Rules = None,
    change: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="A key of a match file: radio.loss=0.2; repeatable."),
    ] = None,
    jobs: Annotated[int, typer.Option(help="Number of drills at a time; 0 for one per core.")] = 0,
    json: options.Json = False,
) -> None:
    """Play a drill from many seeds in parallel, without a network, and print its score with an interval of 95 %.

    Each seed has another start, as its table `vary` allows, and other noise. Equal seeds give equal drills.
    `touchline scenes` lists the scenes. If a brain raises, its drill counts as not played, and the exit status is 1.

    Example: touchline drill one_against_keeper --brain simple --seeds 1-50
    """
    options.need_pybullet()
    from touchline.matches.drill.play_drill import play_drills
    from touchline.matches.engine.child_processes import cores
    from touchline.matches.engine.progress import progress_of

    if jobs < 0:
        raise TouchlineError(f"--jobs is {jobs}; give a number of drills at a time, or 0 for one per core")
    settings = {key: value for key, value in {"profile": profile, "rules": rules}.items() if value is not None}
    planned = _plan(scene, brain, opponents, seeds, settings | options.settings_of(change or []))
    rows: list[DrillRow] = []
    interrupted = False
    try:
        with (
            sigterm_interrupts(),
            closing(play_drills(planned, jobs or cores())) as played,
            progress_of(len(planned), scene, at_once=jobs or cores(), json=json) as progress,
        ):
            for row in played:
                rows.append(row)
                progress.ended(_sentence(row), failed=row.verdict is None)
    except KeyboardInterrupt:
        interrupted = True
    rows.sort(key=lambda row: row.seed)
    _print(scene, rows, len(planned), json=json)
    if interrupted:
        raise typer.Exit(128 + signal.SIGINT)
    if any(row.verdict is None for row in rows):
        raise typer.Exit(FAILED)


def _plan(scene: str, brain: str, opponents: str, seeds: str, settings: dict[str, object]) -> "list[PlannedDrill]":
    """One drill for each seed; the teams are built once, so that an error is reported before the first.

    Raises:
        TouchlineError: the scene has no drill, or an option is invalid.
    """
    from schemas.config.scene import load_scene, shipped_scenes
    from touchline.matches.drill.drill_match import drill_match
    from touchline.matches.drill.play_drill import PlannedDrill
    from touchline.matches.series.seeds import seeds_of
    from touchline.matches.series.team_names import brain_of
    from touchline.play import InProcessMatch

    loaded = load_scene(scene)
    if loaded.drill is None:
        known = ", ".join(name for name in shipped_scenes() if load_scene(name).drill is not None)
        raise TouchlineError(f"scene {scene} has no [drill] with an end and a verdict; give one of {known}")
    side = loaded.drill.side
    teams = {side: brain_of(brain), side.opponent: brain_of(opponents)}
    folder = Path(scene).parent if scene.endswith(".toml") else None
    planned = [PlannedDrill(drill_match(loaded, seed, teams, settings), folder) for seed in seeds_of(seeds)]
    InProcessMatch(planned[0].config, brain_folder=folder).close()
    return planned


def _sentence(row: "DrillRow") -> str:
    if row.verdict is None:
        return f"seed {row.seed}: not played: {row.reason}"
    kind = "success" if row.verdict.success else "failure"
    return f"seed {row.seed}: {kind}, {row.verdict.because} after {row.verdict.time:.1f} s"


def _print(scene: str, rows: "list[DrillRow]", planned: int, *, json: bool) -> None:
    from touchline.matches.series.intervals import share

    verdicts = [row.verdict for row in rows if row.verdict is not None]
    score = sum(verdict.success for verdict in verdicts)
    estimate = share(score, len(verdicts))
    if json:
        drills = [dataclasses.asdict(row) for row in rows]
        interval = dataclasses.asdict(estimate) if estimate is not None else None
        typer.echo(json_text.dumps({"scene": scene, "planned": planned, "score": interval, "drills": drills}))
        return
    if estimate is not None and estimate.low is not None and estimate.high is not None:
        interval_text = f"{100 * estimate.value:.0f} % ({100 * estimate.low:.0f} to {100 * estimate.high:.0f} %)"
        typer.echo(f"{scene}: {score} of {len(verdicts)}, {interval_text}; in brackets: interval of 95 %")
    ends = Counter((not verdict.success, verdict.because) for verdict in verdicts)
    for (failed, because), count in sorted(ends.items(), key=lambda item: (item[0][0], -item[1])):
        times = [one.time for one in verdicts if one.because == because]
        mean = sum(times) / len(times)
        typer.echo(f"  {'failure' if failed else 'success'}  {because}  {count}, on average after {mean:.1f} s")
    for row in rows:
        if row.verdict is None:
            typer.echo(_sentence(row), err=True)
    if len(rows) < planned:
        typer.echo(f"{planned - len(rows)} not played")
