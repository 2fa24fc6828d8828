"""`touchline series`: many matches between two teams, and their figures with intervals."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.commands.cli.option_groups import FieldsOf, with_option_groups
from touchline.launch.terminal.aligned import aligned
from touchline.launch.terminal.json_text import json_text
from touchline.matches.series.seeds import seeds_of

if TYPE_CHECKING:
    from touchline.matches.engine.failures import Failures
    from touchline.matches.engine.outcome import Outcome, Played
    from touchline.matches.engine.planned_match import PlannedMatch
    from touchline.matches.series.match_row import FailedMatch, MatchRow, Row
    from touchline.matches.series.plan import SeriesPlan
    from touchline.matches.series.summary import Summary

_TEAM_HELP = "The team in {}: a shipped team, module:Class or policy:FILE; by default the match file's."


@with_option_groups
def series(
    file: options.MatchFile = None,
    seeds: options.Seeds = "1-20",
    both_sides: Annotated[
        bool, typer.Option("--both-sides", help="Play each seed twice, the second time with sides swapped.")
    ] = False,
    cyan: Annotated[str | None, typer.Option(metavar="TEAM", help=_TEAM_HELP.format("cyan"))] = None,
    magenta: Annotated[str | None, typer.Option(metavar="TEAM", help=_TEAM_HELP.format("magenta"))] = None,
    scene: options.Scene = None,
    profile: options.Profile = None,
    rules: options.Rules = None,
    change: options.Changes = None,
    record: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Keep a recording of each match in this folder.")
    ] = None,
    failures: options.Failures = 0,
    jobs: options.Jobs = 0,
    json: options.Json = False,
    *,
    changes: Annotated[dict[str, Any], FieldsOf(MatchConfig, "duration")],
) -> None:
    """Play a series of matches in parallel, without a network, and print their figures with intervals of 95 %.

    Equal seeds give equal matches, whatever the number of jobs. The figures are as in `touchline stats`. Ctrl-C
    prints the figures of the matches played so far. With --failures, the worst matches are those that the first team
    lost by most goals, or won by fewest. If a brain raises, its match is reported as failed, the
    series goes on, and the exit status is 1.

    Example: touchline series --cyan simple --magenta nubot --rules msl --seeds 1-20 --both-sides
    """
    options.need_statistics()
    from touchline.launch.run_folder import new_run_folder
    from touchline.matches.engine.failures import keep_failures
    from touchline.matches.engine.play_list import play_list
    from touchline.matches.series.match_row import row_of, rows_of
    from touchline.matches.series.plan import plan_series, with_brains
    from touchline.matches.series.table import sentence_of

    named = {"scene": scene, "profile": profile, "rules": rules, **changes}
    settings = {key.replace(".", "__"): value for key, value in options.settings_of(change or []).items()}
    config = options.read_match(file, **settings, **named)
    config = with_brains(
        config, {side: brain_of(team) for side, team in zip(Side, (cyan, magenta), strict=True) if team is not None}
    )
    if note := options.pitch_note(config):
        typer.echo(f"note: {note}", err=True)
    plan = plan_series(
        config, seeds_of(seeds), both_sides=both_sides, brain_folder=file.parent if file else None, record=record
    )
    for one in plan.matches:
        if (taken := one.planned.recording) is not None and taken.exists():
            raise TouchlineError(f"{taken}: already exists; give another folder with --record, or move that one away")
    matches = {one.identity: one for one in plan.matches}

    def sentence(planned: "PlannedMatch", outcome: "Outcome") -> str:
        return sentence_of(row_of(0, matches[planned.identity], outcome), plan)

    played = play_list([one.planned for one in plan.matches], jobs, " – ".join(plan.teams), sentence, json=json)
    kept = None
    if failures and not played.is_interrupted:

        def lead(outcome: "Played") -> float:
            first, second = matches[outcome.identity].sides
            return float(outcome.goals[first] - outcome.goals[second])

        planned = [one.planned for one in plan.matches]
        folder = record or new_run_folder(f"{config.name}-failures", WallClock())
        kept = keep_failures(planned, played.outcomes, lead, failures, folder, jobs, json=json)
    failed = _print(plan, rows_of(plan, played.outcomes), kept, json=json)
    if played.is_interrupted or (kept is not None and kept.is_interrupted):
        raise KeyboardInterrupt
    if failed or (kept is not None and kept.missing):
        raise typer.Exit(FAILED)


def _print(plan: "SeriesPlan", ended: "list[Row]", kept: "Failures | None", *, json: bool) -> bool:
    """Print the figures; returns whether a match has failed."""
    from touchline.matches.series.match_row import FailedMatch, MatchRow
    from touchline.matches.series.summary import summary_of
    from touchline.matches.series.table import sentence_of

    rows = [one for one in ended if isinstance(one, MatchRow)]
    failed = [one for one in ended if isinstance(one, FailedMatch)]
    summary = summary_of(rows)
    if json:
        parts = {"summary": summary, "matches": rows, "failed": failed}
        parts |= {"failures": kept} if kept is not None else {}
        typer.echo(json_text({"teams": plan.teams, "planned": len(plan.matches), **parts}))
        return bool(failed)
    _show(plan, summary, rows, failed)
    for one in failed:
        typer.echo(sentence_of(one, plan), err=True)
    for line in kept.lines if kept is not None else []:
        typer.echo(line)
    return bool(failed)


def _show(plan: "SeriesPlan", summary: "Summary", rows: "list[MatchRow]", failed: "list[FailedMatch]") -> None:
    from touchline.matches.series.table import figure_rows, headline, longest_line

    typer.echo(headline(plan, rows, failed))
    if not rows:
        return
    for heading, figures in (((*plan.teams,), summary.teams), ((*Side,), summary.sides), (("both",), summary.match)):
        typer.echo()
        for line in aligned([("", *heading), *figure_rows(figures)]):
            typer.echo(line)
    typer.echo()
    for one in summary.longest:
        typer.echo(longest_line(one))
