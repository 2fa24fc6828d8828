"""`touchline check`: whether a brain or a program keeps the contract of a robot."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.config.match_config import load_match
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from touchline.team.check.subject import Subject


def check(
    brain: Annotated[
        str | None,
        typer.Argument(metavar="[MODULE:CLASS]", help="The brain of all robots: also policy:FILE, or a shipped team."),
    ] = None,
    stdio: options.StdioProgram = None,
    command: Annotated[
        str | None, typer.Option(help="Program that speaks the protocol over Zenoh, in place of a brain.")
    ] = None,
    match: Annotated[
        Path | None, typer.Option("--match-file", help="Robots, profile and rules; by default five a side.")
    ] = None,
    seconds: Annotated[float, typer.Option(min=1.0, max=600.0, help="Simulated s of the match that is played.")] = 12.0,
    for_hardware: Annotated[
        int | None,
        typer.Option(min=1, max=1000, metavar="SCENES", help="Play so many seeded scenes: may it run on hardware?"),
    ] = None,
    clearance: Annotated[
        float | None, typer.Option(min=0.0, max=5.0, help="With --for-hardware: the filter that keeps so many m.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Check a brain or a program of lines: a match, and sights of situations that are rare in play.

    Exit status 0: the contract is kept; 1: it is broken, and the sentences name how and the remedy.

    With --for-hardware the team plays seeded scenes alone instead, and is rejected where robots touch bodies or the
    boundary, or think too long.

    Example: touchline check my_team:Striker

    Example: touchline check my_team:Striker --for-hardware 20
    """
    from touchline.team.check.checks import run_checks
    from touchline.team.check.examination import Examination
    from touchline.team.check.fresh_checks import run_fresh
    from touchline.team.check.subject import Subject

    if [brain, stdio, command].count(None) != 2:
        raise TouchlineError('name the brain, module:Class, or give --stdio "program argument" or --command')
    overrides = {"teams.cyan.remote": True}  # the team of the file is not that which is checked
    subject = Subject(
        config=load_match(match, overrides),
        brain=brain_of(brain) if brain is not None else "",
        stdio=options.program_of(stdio),
        command=options.program_of(command, "--command"),
        folder=match.parent if match is not None else None,
    )
    if not subject.robots:
        raise TouchlineError("the match has no robots of cyan that an agent moves; name another match file")
    if clearance is not None and for_hardware is None:
        raise TouchlineError("--clearance is that of the filter of hardware; add --for-hardware SCENES")
    if for_hardware is not None:
        raise typer.Exit(_gate(subject, for_hardware, seconds, clearance, json=json))
    results = []
    for result in run_fresh(subject, seconds) if subject.brain else run_checks(Examination(subject, seconds)):
        results.append(result)
        if not json and result.kept is not None:
            typer.echo(f"{'kept' if result.kept else 'broken':<7} {result.name:<12} {result.sentence}")
    is_kept = all(result.kept for result in results)
    unjudged = ", ".join(result.name for result in results if result.kept is None)
    if unjudged and not json:
        typer.echo(f"not judged because of this: {unjudged}")
    if json:
        typer.echo(json_text({"kept": is_kept, "checks": results}, indent=2))
    raise typer.Exit(0 if is_kept else 1)


def _gate(subject: "Subject", scenes: int, seconds: float, clearance: float | None, *, json: bool) -> int:
    """Play the scenes of the seeds from 1; the exit status."""
    from touchline.team.check.hardware_gate import pass_scenes

    results = []
    for result in pass_scenes(subject, scenes, seconds, clearance):
        results.append(result)
        if not json:
            said = f"rejected: {result.rejected}" if result.rejected else "run"
            clear = f"{result.clearance:.2f} m" if result.clearance is not None else "unknown"
            figures = f"clearance {clear}, {result.clamped} demands shortened"
            typer.echo(f"scene {result.seed:<4} {said}; {figures}")
    rejected = sum(bool(result.rejected) for result in results)
    if json:
        typer.echo(json_text({"run": not rejected, "scenes": [result._asdict() for result in results]}, indent=2))
    else:
        typer.echo(f"rejected: {rejected} of {scenes} scenes" if rejected else f"run: {scenes} scenes without a fault")
    return 1 if rejected else 0
