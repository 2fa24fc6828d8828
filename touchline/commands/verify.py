"""`touchline verify`: simulates a recorded match again and compares every tick."""

import os
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from touchline.verify.verdict import Detail, Discrepancy, Verdict

_DETAILS = 6
"""Maximum number of differences that are listed; the rest is counted."""
_UNITS = {"x": "m", "y": "m", "z": "m", "heading": "rad", "vx": "m/s", "vy": "m/s", "vz": "m/s", "omega": "rad/s"}


def verify(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    from_kickoff: Annotated[
        int | None, typer.Option("--from-kickoff", help="Start at this kick-off, counted from 1, instead of tick 0.")
    ] = None,
    jobs: Annotated[int, typer.Option(help="Number of parallel processes; 0 for one per core.")] = 0,
    referee: Annotated[
        bool | None,
        typer.Option(
            "--referee/--no-referee",
            help="Simulate the referee, too; by default where the recording has its settings and states. The score of "
            "a free game is a program in the recording, which runs with --referee only.",
            show_default=False,
        ),
    ] = None,
    json: options.Json = False,
) -> None:
    """Simulate a recorded match again and compare every tick: identical, or the first tick that differs.

    Example: touchline verify final.mcap --from-kickoff 2
    """
    options.need_pybullet()
    from touchline.verify.resimulate import verify as verified

    if jobs < 0:
        raise TouchlineError(f"--jobs is {jobs}; give a number of processes, or 0 for one per core")
    verdict = verified(file, from_kickoff, jobs or len(os.sched_getaffinity(0)), referee)
    if json:
        typer.echo(json_text({"identical": verdict.identical, **asdict(verdict)}))
    else:
        for line in _lines(verdict):
            typer.echo(line)
    raise typer.Exit(0 if verdict.identical else FAILED)


def _lines(verdict: "Verdict") -> list[str]:
    """The verdict as text; a different machine is reported first, because it may explain the rest."""
    lines = [
        f"{part} differs from the recording: {theirs} there, {ours} here; results may differ"
        for part, (theirs, ours) in verdict.other_machine.items()
    ]
    if verdict.difference is not None:
        lines += _of_difference(verdict.difference)
        lines += [verdict.other_program] if verdict.other_program else []
        lines.append(f"identical before that: {verdict.ticks} ticks")
    else:
        lines.append(
            f"{'identical' if verdict.identical else 'identical where it could be compared'}, {verdict.ticks} ticks"
        )
    lines += [f"the recording contradicts itself: {sentence}" for sentence in verdict.contradictions[:_DETAILS]]
    if len(verdict.contradictions) > _DETAILS:
        lines.append(f"  and {len(verdict.contradictions) - _DETAILS} more contradictions")
    lines += [_LEFT_OUT[one.why].format(_range(one.first, one.last)) for one in verdict.left_out]
    if verdict.without_world:
        lines.append(f"{verdict.without_world} ticks have no recorded world; their hash chain was compared")
    rate = verdict.seconds / verdict.took
    how = "one process" if verdict.processes == 1 else f"{verdict.processes} processes"
    lines.append(
        f"{verdict.seconds:.1f} s of the match simulated again in {verdict.took:.1f} s by {how}, ×{rate:.0f}; "
        f"kick-offs to start from: {verdict.kick_offs}"
    )
    lines.append(f"not checked: {'; '.join(verdict.not_checked)}")
    return lines


_LEFT_OUT = {
    "before": "{} are older than the recording",
    "missing": "{} are missing in the recording and were not verified",
    "no_start": "{} are before the first tick that a simulation can start from and were not verified",
}


def _range(first: int, last: int) -> str:
    return f"ticks {first} to {last}" if last > first else f"tick {first}"


def _of_difference(one: "Discrepancy") -> list[str]:
    lines = [f"tick {one.tick} ({one.time:.2f} s) is the first that differs: {one.why}"]
    lines += [f"  {_of_detail(detail)}" for detail in one.details[:_DETAILS]]
    if len(one.details) > _DETAILS:
        lines.append(f"  and {len(one.details) - _DETAILS} more")
    return lines


def _of_detail(one: "Detail") -> str:
    other = "in its command" if one.of.startswith("input") else "simulated again"
    if one.field == "message":
        return _of_message(one)
    if one.of.startswith("belief"):
        return f"{one.of}: {one.recorded} is recorded"
    by = f", {one.by:.3g} {_UNITS.get(one.field.split('.')[-1], '')}".rstrip() + " apart" if one.by is not None else ""
    return f"{one.of}: {one.field} is {one.recorded} recorded, {one.simulated} {other}{by}"


def _of_message(one: "Detail") -> str:
    """A whole message that is missing, or that the simulation does not have."""
    if one.recorded is None:
        return f"{one.of} is missing: {one.simulated}"
    if one.simulated is None:
        return f"{one.of} is recorded and not simulated: {one.recorded}"
    return f"{one.of} is {one.recorded} recorded, {one.simulated} simulated again"
