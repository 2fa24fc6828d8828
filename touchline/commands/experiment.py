"""`touchline experiment`: studies over factors of a match, and their reproduction."""

from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from runtime.process.installed import need
from schemas.side import Side
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.launch.terminal.aligned import counted
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from touchline.matches.engine.outcome import Outcome
    from touchline.matches.engine.planned_match import PlannedMatch

NEEDED = ("scipy", "pandas", "pyarrow", "matplotlib")
Folder = Annotated[Path, typer.Argument(metavar="FOLDER", help="The folder of a study that was played.")]


app = typer.Typer(
    cls=options.RunGroup,
    no_args_is_help=True,
    help="Answer a question with many matches: `touchline experiment STUDY.toml` plays a study and writes its report."
    "\n\nExample: touchline experiment studies/sides.toml",
)


@app.command()
def run(
    file: Annotated[Path, typer.Argument(metavar="STUDY.toml", help="The study file.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder of the study; by default runs/ and its name.")
    ] = None,
    seeds: Annotated[str | None, typer.Option(metavar="SEEDS", help="In place of the file's: 1-50.")] = None,
    until_interval: Annotated[
        float | None,
        typer.Option(metavar="WIDTH", help="Add seeds until the interval of the first response is at most this wide."),
    ] = None,
    most_seeds: Annotated[int | None, typer.Option(help="Most seeds of a cell with --until-interval.")] = None,
    record: Annotated[bool | None, typer.Option("--keep-recordings", help="Keep a recording of each match.")] = None,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Play all matches again, also those that have a result.")
    ] = False,
    failures: options.Failures = 0,
    jobs: options.Jobs = 0,
    dask: options.Dask = None,
    json: options.Json = False,
) -> None:
    """Play all matches of a study that have no result yet, and write results and report.

    A study that was interrupted goes on where it stopped: the result of each match is stored as soon as it has ended.
    `touchline experiment STUDY.toml` is short for this command. If a match fails, the others go on, and the exit
    status is 1. With --failures, the worst matches are those with the least values of the first response.

    Example: touchline experiment run studies/sides.toml --jobs 2
    """
    _need_packages()
    from touchline.matches.engine.failures import keep_failures
    from touchline.matches.engine.session import session_of
    from touchline.matches.engine.store import RunStore
    from touchline.matches.study.cells import cells_of
    from touchline.matches.study.comparisons import answers, compared, unread_factors
    from touchline.matches.study.run_study import run_study
    from touchline.matches.study.sentences import sentence_of, sentence_of_missing, sentence_of_unread
    from touchline.matches.study.study_config import load_study
    from touchline.matches.study.study_folder import REPORT, read_study
    from touchline.matches.study.study_plan import StudyPlan

    given = {"seeds": seeds, "until_interval": until_interval, "most_seeds": most_seeds, "record": record}
    study = load_study(file, {key: value for key, value in given.items() if value is not None})
    home = (file.parent / study.match).parent if study.match is not None else file.parent
    folder = out or Path("runs") / study.name
    plan = StudyPlan(study, cells_of(study, file.parent), home, folder)
    with session_of(study.name, jobs, dask, json=json) as session, session.interruptible():
        how = session.executor, _match_sentence, session.progress
        result = run_study(plan, folder, *how, fresh=fresh, is_remote=session.is_remote)
    if session.is_interrupted:
        typer.echo(f"interrupted; the matches played so far are in {folder}: run it again to go on", err=True)
        raise KeyboardInterrupt
    failed = result.failed
    stored = read_study(folder)
    kept = None
    if failures:
        measured = stored.table.reindex(columns=["identity", study.primary]).dropna()
        worths = dict(zip(measured["identity"], measured[study.primary], strict=True))
        planned = [one.planned for one in plan.matches(result.seeds)]
        with closing(RunStore(folder, read_only=True)) as store:
            outcomes = store.outcomes()
        kept = keep_failures(planned, outcomes, lambda one: worths.get(one.identity), failures, folder, jobs, json=json)
    sentences = [sentence_of_missing(name, list(stored.table)) for name in study.responses if name not in stored.table]
    sentences += [sentence_of_unread(key) for key in unread_factors(plan, stored.table)]
    sentences += [
        sentence_of(one, name) for name, groups in compared(plan, stored.table).items() for one in answers(groups)
    ]
    if json:
        content = {"folder": str(folder), "seeds": result.seeds, "played": result.played, "answers": sentences}
        content["failed"] = [{"identity": one.identity, "reason": one.reason} for one in failed]
        content["disturbed"] = result.disturbed
        content |= {"failures": kept} if kept is not None else {}
        typer.echo(json_text(content))
    else:
        for sentence in [*sentences, *(kept.lines if kept is not None else ())]:
            typer.echo(sentence)
        typer.echo(f"report  {folder / REPORT}")
    if failed:
        typer.echo(f"{counted(len(failed), 'match')} failed: {failed[0].reason}", err=True)
    for sentence in result.disturbed:
        typer.echo(f"match {sentence}", err=True)
    if kept is not None and kept.is_interrupted:
        raise KeyboardInterrupt
    if failed or result.disturbed or (kept is not None and kept.missing):
        raise typer.Exit(FAILED)


@app.command()
def verify(
    folder: Folder,
    sample: options.Sample = None,
    brains: options.Brains = None,
    jobs: options.Jobs = 0,
    json: options.Json = False,
) -> None:
    """Check a study: digests, table, and matches simulated again. Exit status 1 if something does not fit.

    A match is simulated from its recording, where the study has one; otherwise it is played again.

    Example: touchline experiment verify studies/sides --sample 4
    """
    _check(folder, sample, brains, jobs, from_recordings=True, json=json)


@app.command()
def reproduce(
    folder: Folder, brains: options.Brains = None, jobs: options.Jobs = 0, json: options.Json = False
) -> None:
    """Play all matches of a study again and compare the table of results to the byte. Exit status 1 if it differs.

    Example: touchline experiment reproduce studies/sides
    """
    _check(folder, None, brains, jobs, from_recordings=False, json=json)


def _check(
    folder: Path, sample: int | None, brains: Path | None, jobs: int, *, from_recordings: bool, json: bool
) -> None:
    _need_packages()

    from touchline.matches.engine.session import session_of
    from touchline.matches.study.verify_study import verify_study

    with session_of(folder.name, jobs, json=json) as session:
        verdict = verify_study(
            folder, session.executor, sample, brains, session.progress, from_recordings=from_recordings
        )
    if json:
        typer.echo(json_text(verdict))
    else:
        for line in (*verdict.notes, *verdict.faults):
            typer.echo(line)
        if not verdict.faults:
            same = "; the table of results is the same to the byte" if verdict.byte_identical else ""
            typer.echo(f"identical: {verdict.played_again} matches simulated again{same}")
    if verdict.faults:
        raise typer.Exit(FAILED)


def _match_sentence(planned: "PlannedMatch", outcome: "Outcome") -> str:
    from touchline.matches.engine.outcome import Failed

    if isinstance(outcome, Failed):
        return f"{planned.label}: failed: {outcome.reason}"
    if outcome.value is not None:
        return f"{planned.label}: score {outcome.value:.6g} after {outcome.playing_time:.1f} s"
    return f"{planned.label}: cyan {outcome.goals[Side.CYAN]} : {outcome.goals[Side.MAGENTA]} magenta"


def _need_packages() -> None:
    """Check that this machine can simulate and analyse.

    Raises:
        TouchlineError: a package is missing; the message has the command that installs it.
    """
    options.need_pybullet()
    for package in NEEDED:
        need(f"experiments need {package}, which is not installed", "study", package)
