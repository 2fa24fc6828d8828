"""`touchline tournament`: a cup between many teams, its table, its pages, and its verification."""

import json as json_text
import signal
from contextlib import ExitStack, closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from schemas.errors import TouchlineError
from touchline.cli import options
from touchline.cli.errors import FAILED

if TYPE_CHECKING:
    from touchline.tournament.cup_state import CupState, Ended, Slot

VERIFY = "verify"


def tournament(
    file: Annotated[Path, typer.Argument(metavar="CUP.toml | verify", help="The cup file; or verify, and a folder.")],
    folder: Annotated[Path | None, typer.Argument(metavar="[FOLDER]", help="The folder of a cup to verify.")] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="The folder of the cup; by default runs/ and its name.")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with the cup of the folder.")] = False,
    jobs: Annotated[int, typer.Option(help="Number of matches at a time; 0 for one per core.")] = 0,
    until_significant: Annotated[
        int | None,
        typer.Option(metavar="MATCHES", help="Add rounds until the order is significant, up to this many matches."),
    ] = None,
    web: Annotated[
        bool, typer.Option("--web", help="Serve the pages while the cup runs, and print the address.")
    ] = False,
    port: Annotated[int, typer.Option(help="Port of --web; 0 for a free one.")] = 0,
    sample: Annotated[int, typer.Option(help="Of verify: simulate this many matches again; 0 for all.")] = 0,
    json: options.Json = False,
) -> None:
    """Play a cup between many teams: table, bracket, ratings, and a folder of pages with every match.

    Each result is stored at once: after a crash or Ctrl-C, --resume goes on and repeats no finished match. A team that
    does not start, crashes or hangs forfeits. `touchline tournament verify FOLDER` simulates the matches again, and
    compares results and table. The exit status is 1 if a match has no result, or does not fit.

    Example: touchline tournament matches/cup.toml --web
    """
    options.need_pybullet()
    if str(file) == VERIFY:
        if folder is None:
            raise TouchlineError("verify needs the folder of a cup: touchline tournament verify runs/cup")
        _verify(folder, jobs, sample, json=json)
        return
    if folder is not None:
        raise TouchlineError(f"{folder}: one cup file is enough; use --out for the folder of the cup")
    from touchline.scheduling.child_processes import cores
    from touchline.tournament.cup_config import SignificanceConfig, load_cup
    from touchline.tournament.playing.run_cup import CupRun
    from touchline.tournament.progress import progress_of
    from touchline.tournament.ratings import need_scipy
    from touchline.tournament.serve import served

    if jobs < 0:
        raise TouchlineError(f"--jobs is {jobs}; give a number of matches at a time, or 0 for one per core")
    cup = load_cup(file)
    if until_significant is not None:
        changes = {"until_significant": SignificanceConfig(budget=until_significant)}
        cup = type(cup).model_validate(cup.model_copy(update=changes).model_dump())
    if cup.until_significant is not None:
        need_scipy("until_significant")
    place = out or Path("runs") / cup.name
    with ExitStack() as stack:
        run = stack.enter_context(closing(CupRun(cup, file.parent.resolve(), place, resume=resume)))
        if web:
            typer.echo(f"pages  {stack.enter_context(served(place, port))}", err=json)
        state, interrupted = run.state, False
        try:
            with progress_of(state) as report:

                def ended(now: "CupState", slot: "Slot", end: "Ended") -> None:
                    report(now, _sentence(slot, end))

                state = run.play(jobs or cores(), ended)
        except KeyboardInterrupt:
            interrupted, state = True, run.state
    _print(state, place, json=json)
    if interrupted:
        raise typer.Exit(128 + signal.SIGINT)
    if not state.is_complete:
        raise typer.Exit(FAILED)


def _sentence(slot: "Slot", end: "Ended") -> str:
    """One line on a match that has ended."""
    from touchline.tournament.site.links import score_text

    cyan, magenta = slot.sides
    score = score_text(end.result, cyan) if end.result is not None else "failed"
    reason = f"   {end.reason}" if end.reason is not None else ""
    return f"{slot.name}: {cyan} {score} {magenta}{reason}"


def _print(state: "CupState", folder: Path, *, json: bool) -> None:
    from touchline.tournament.report import report_of, report_text

    if json:
        typer.echo(json_text.dumps(report_of(state), ensure_ascii=False))
        return
    typer.echo(report_text(state))
    typer.echo(f"pages  {folder / 'index.html'}")


def _verify(folder: Path, jobs: int, sample: int, *, json: bool) -> None:
    from touchline.scheduling.child_processes import cores
    from touchline.tournament.playing.verify_cup import verify_cup

    faults, checked = verify_cup(folder, jobs or cores(), sample)
    if json:
        content: dict[str, Any] = {"checked": checked, "faults": faults}
        typer.echo(json_text.dumps(content, ensure_ascii=False))
    else:
        for fault in faults:
            typer.echo(fault)
        typer.echo(f"{checked} matches simulated again, {len(faults) or 'no'} fault{'s' if len(faults) != 1 else ''}")
    if faults:
        raise typer.Exit(FAILED)
