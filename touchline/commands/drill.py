"""`touchline drill`: a scene played from many seeds, and its score with an interval."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.config.scene import load_scene, shipped_scenes
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.launch.terminal.json_text import json_text
from touchline.matches.series.seeds import seeds_of

if TYPE_CHECKING:
    from touchline.matches.engine.outcome import Outcome
    from touchline.matches.engine.planned_match import PlannedMatch
    from touchline.matches.judging.judge import DrillVerdict


def drill(
    scene: Annotated[str, typer.Argument(metavar="SCENE", help="A scene with a table `drill`, by name or path.")],
    brain: Annotated[
        str, typer.Option(metavar="TEAM", help="Who practises: a shipped team, module:Class or policy:FILE.")
    ] = "simple",
    opponents: Annotated[
        str, typer.Option(metavar="TEAM", help="The team of the other side's robots, if the scene has any.")
    ] = "simple",
    seeds: options.Seeds = "1-20",
    profile: options.Profile = None,
    rules: options.Rules = None,
    change: options.Changes = None,
    jobs: options.Jobs = 0,
    json: options.Json = False,
) -> None:
    """Play a drill from many seeds in parallel, without a network, and print its score with an interval of 95 %.

    Each seed has another start, as its table `vary` allows, and other noise. Equal seeds give equal drills.
    `touchline scene list` lists the scenes. If a brain raises, its drill counts as not played, and the exit status
    is 1.

    Example: touchline drill one_against_keeper --brain simple --seeds 1-50
    """
    options.need_statistics()
    from touchline.matches.engine.play_list import play_list

    settings = {key: value for key, value in {"profile": profile, "rules": rules}.items() if value is not None}
    planned = _plan(scene, brain, opponents, seeds, settings | options.settings_of(change or []))
    played = play_list(planned, jobs, scene, _sentence, json=json)
    ended = [(one, played.outcomes[one.identity]) for one in planned if one.identity in played.outcomes]
    _print(scene, ended, len(planned), json=json)
    if played.is_interrupted:
        raise KeyboardInterrupt
    if any(_verdict(outcome) is None for _, outcome in ended):
        raise typer.Exit(FAILED)


def _plan(scene: str, brain: str, opponents: str, seeds: str, settings: dict[str, object]) -> "list[PlannedMatch]":
    """One drill for each seed.

    Raises:
        TouchlineError: the scene has no drill, or an option is invalid.
    """
    from touchline.matches.drill.drill_match import drill_match
    from touchline.matches.engine.planned_match import PlannedMatch

    loaded = load_scene(scene)
    if loaded.drill is None:
        known = ", ".join(name for name in shipped_scenes() if load_scene(name).drill is not None)
        raise TouchlineError(f"scene {scene} has no [drill] with an end and a verdict; give one of {known}")
    side = loaded.drill.side
    teams = {side: brain_of(brain), side.opponent: brain_of(opponents)}
    folder = Path(scene).parent if scene.endswith(".toml") else None
    return [
        PlannedMatch(drill_match(loaded, seed, teams, settings), brain_folder=folder, is_drill=True)
        for seed in seeds_of(seeds)
    ]


def _verdict(outcome: "Outcome") -> "DrillVerdict | None":
    from touchline.matches.engine.outcome import Played

    return outcome.verdict if isinstance(outcome, Played) else None


def _reason(outcome: "Outcome") -> str:
    """Why a drill was not played."""
    return "" if _verdict(outcome) is not None else getattr(outcome, "reason", "the match ended before the drill")


def _sentence(planned: "PlannedMatch", outcome: "Outcome") -> str:
    if (verdict := _verdict(outcome)) is None:
        return f"seed {planned.config.seed}: not played: {_reason(outcome)}"
    kind = "success" if verdict.success else "failure"
    return f"seed {planned.config.seed}: {kind}, {verdict.because} after {verdict.time:.1f} s"


def _print(scene: str, ended: "list[tuple[PlannedMatch, Outcome]]", planned: int, *, json: bool) -> None:
    from touchline.matches.statistics.estimates import share

    verdicts = [verdict for _, outcome in ended if (verdict := _verdict(outcome)) is not None]
    score = sum(verdict.success for verdict in verdicts)
    estimate = share(score, len(verdicts))
    if json:
        drills = [
            {"seed": one.config.seed, "verdict": _verdict(outcome), "reason": _reason(outcome)}
            for one, outcome in ended
        ]
        typer.echo(json_text({"scene": scene, "planned": planned, "score": estimate, "drills": drills}))
        return
    if estimate is not None and estimate.low is not None and estimate.high is not None:
        interval_text = f"{100 * estimate.value:.0f} % ({100 * estimate.low:.0f} to {100 * estimate.high:.0f} %)"
        typer.echo(f"{scene}: {score} of {len(verdicts)}, {interval_text}; in brackets: interval of 95 %")
    ends = Counter((not verdict.success, verdict.because) for verdict in verdicts)
    for (failed, because), count in sorted(ends.items(), key=lambda item: (item[0][0], -item[1])):
        times = [one.time for one in verdicts if one.because == because]
        mean = sum(times) / len(times)
        typer.echo(f"  {'failure' if failed else 'success'}  {because}  {count}, on average after {mean:.1f} s")
    for one, outcome in ended:
        if _verdict(outcome) is None:
            typer.echo(_sentence(one, outcome), err=True)
    if len(ended) < planned:
        typer.echo(f"{planned - len(ended)} not played")
