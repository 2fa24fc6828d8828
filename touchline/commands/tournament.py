"""`touchline tournament`: a cup between many teams, its table, its pages, and its verification."""

import re
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.config.shipped_teams import policy_file
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.launch.confinement.team_code import team_code
from touchline.launch.terminal.aligned import counted
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from touchline.matches.cup.cup_config import CupConfig
    from touchline.matches.cup.cup_state import CupState

app = typer.Typer(
    cls=options.RunGroup,
    no_args_is_help=True,
    help="Find the best of many teams: `touchline tournament CUP.toml` plays a cup and writes its pages."
    "\n\nExample: touchline tournament matches/cup.toml",
)


@app.command()
def run(
    file: Annotated[Path, typer.Argument(metavar="CUP.toml", help="The cup file.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="The folder of the cup; by default runs/ and its name.")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with the cup of the folder.")] = False,
    jobs: options.Jobs = 0,
    dask: options.Dask = None,
    until_significant: Annotated[
        int | None,
        typer.Option(metavar="MATCHES", help="Add rounds until the order is significant, up to this many matches."),
    ] = None,
    json: options.Json = False,
) -> None:
    """Play a cup between many teams: table, bracket, ratings, and a folder of pages with every match.

    Each result is stored at once: after a crash or Ctrl-C, --resume goes on and repeats no finished match. A team that
    does not start, crashes, hangs or breaks the access rules forfeits. `touchline tournament CUP.toml` is short for
    this command. The exit status is 1 if a match has no result.

    Example: touchline tournament run matches/cup.toml --jobs 2
    """
    options.need_statistics()
    from touchline.matches.cup.run_cup import CupRun
    from touchline.matches.engine.session import session_of

    cup = _cup_of(file, until_significant)
    place = out or Path("runs") / cup.name
    with (
        session_of(cup.title or cup.name, jobs, dask, json=json) as session,
        closing(CupRun(cup, file.parent.resolve(), place, resume=resume)) as played,
        session.interruptible(),
    ):
        played.play(session.executor, session.progress, is_remote=session.is_remote)
    _print(played.state, place, json=json)
    if session.is_interrupted:
        typer.echo(f"interrupted; --resume goes on with the matches that are missing in {place}", err=True)
        raise KeyboardInterrupt
    if played.state.disturbed or not played.state.is_complete:
        raise typer.Exit(FAILED)


def _cup_of(file: Path, until_significant: int | None) -> "CupConfig":
    from touchline.matches.cup.cup_config import SignificanceConfig, load_cup

    cup = load_cup(file)
    if until_significant is not None:
        changes = {"until_significant": SignificanceConfig(budget=until_significant)}
        cup = type(cup).model_validate(cup.model_copy(update=changes).model_dump())
    return cup


def _print(state: "CupState", folder: Path, *, json: bool) -> None:
    from touchline.matches.cup.report import report_of, report_text

    if json:
        typer.echo(json_text(report_of(state)))
        return
    typer.echo(report_text(state))
    typer.echo(f"pages  {folder / 'index.html'}")


@app.command()
def digest(
    brain: Annotated[str, typer.Argument(metavar="BRAIN", help="Of a team in the current directory: my_team:MyTeam.")],
) -> None:
    """Print the digest of a team's files, which a cup file names.

    Example: touchline tournament digest my_team.my_team:MyTeam
    """
    from robot_agent.loading.brain_folders import BrainFolders
    from touchline.matches.cup.cup_config import CupConfig, TeamEntry
    from touchline.matches.cup.cup_plan import config_with
    from touchline.matches.engine.code_digest import code_digest

    teams = [TeamEntry(name=name, brain=brain) for name in ("one", "other")]
    config = config_with(teams[0], CupConfig(teams=teams))
    if not team_code(config, Side.CYAN, Path.cwd()).own:
        raise TouchlineError(f"{brain}: no file of it is in {Path.cwd()}; a digest is for a team's own files")
    module, _, name = brain.partition(":")
    file = BrainFolders().file_of(module)
    code = file.read_text("utf-8", "replace") if file is not None else ""  # which is not run: it may be a rival's
    if not policy_file(brain) and not re.search(rf"\b{re.escape(name)}\b|import \*", code):
        raise TouchlineError(f"{brain}: {file or module} has no {name}; name the module and its class")
    typer.echo(code_digest(config, Side.CYAN, Path.cwd()))


@app.command()
def verify(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="The folder of a cup that was played.")],
    sample: options.Sample = None,
    brains: options.Brains = None,
    jobs: options.Jobs = 0,
    json: options.Json = False,
) -> None:
    """Check a cup: digests, results, table, and matches simulated again. Exit status 1 if something does not fit.

    Example: touchline tournament verify runs/cup --sample 3
    """
    options.need_statistics()
    from touchline.matches.cup.verify_cup import verify_cup
    from touchline.matches.engine.session import session_of

    with session_of(f"verify {folder.name}", jobs, json=json) as session:
        verdict = verify_cup(folder, session.executor, sample, brains, session.progress)
    if json:
        typer.echo(json_text(verdict))
    else:
        for line in (*verdict.notes, *verdict.faults):
            typer.echo(line)
        faults = counted(len(verdict.faults), "fault") if verdict.faults else "no faults"
        typer.echo(f"{counted(verdict.simulated, 'match')} simulated again, {verdict.ticks} ticks, {faults}")
    if verdict.faults:
        raise typer.Exit(FAILED)
