"""Options shared by several commands, and groups of them."""

import importlib.util
import math
import shlex
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from coach_gateway.web.settings import WebSettings
from recordings.container.key_selection import KeySelection
from robot_agent.process.stdio.command_line import check_command_line, command_line
from runtime.bus.settings import ListenSettings, check_protected
from runtime.process.installed import need
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.match_parts import OfficiatingConfig
from schemas.config.profile import SHIPPED as PROFILES
from schemas.config.profile import load_profile
from schemas.config.robot_model import models_of
from schemas.config.soccer.rule_book import SHIPPED as RULE_BOOKS
from schemas.errors import TouchlineError
from schemas.side import Side
from sim_host.missing_engine import missing_engine_text
from touchline.commands.cli.option_groups import FieldsOf

MatchFile = Annotated[
    Path | None, typer.Argument(metavar="[MATCH.toml]", help="The match file; without one, a five-a-side friendly.")
]
Scene = Annotated[str | None, typer.Option(help="Start in this scene, by name or path; see touchline scene list.")]
Profile = Annotated[
    str | None, typer.Option(help=f"Field, bodies and limits: {', '.join(PROFILES)}, or the path of a file.")
]
Rules = Annotated[str | None, typer.Option(help=f"Rule book: {', '.join(RULE_BOOKS)}, or the path of a file.")]
Include = Annotated[
    list[str] | None, typer.Option(help="Include these keys only, such as robot/*/command or team/**; repeatable.")
]
Exclude = Annotated[list[str] | None, typer.Option(help="Leave these keys out; repeatable.")]
From = Annotated[float | None, typer.Option("--from", help="Start, simulated s.")]
To = Annotated[float | None, typer.Option("--to", help="End, simulated s, exclusive.")]
Web = Annotated[bool, typer.Option("--web", help="Serve a page to watch and command from, and print its address.")]
PageOptions = Annotated[dict[str, Any], FieldsOf(WebSettings, "listen_web", port="web_port")]
ForSide = Annotated[Side, typer.Argument(help="cyan or magenta")]
StdioProgram = Annotated[
    str | None,
    typer.Option(
        metavar="COMMAND", help='Program that reads sights and writes commands as lines: "node robot.js"; no brain.'
    ),
]
Json = Annotated[bool, typer.Option("--json", help="Print the result as one JSON object.")]
Seeds = Annotated[str, typer.Option(metavar="SEEDS", help="A range and single seeds: 1-50, or 1-10,31.")]
Changes = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a key of the match file: radio.loss=0.2; repeatable."),
]
Failures = Annotated[
    int, typer.Option(metavar="N", min=0, help="Keep recordings of the N worst matches, and compare their events.")
]
Jobs = Annotated[int, typer.Option(help="Number of matches at a time; 0 for one per core.")]
Sample = Annotated[int | None, typer.Option(min=0, help="Read and simulate only this many matches.")]
Brains = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Where brains and functions are looked for; by default as then.")
]
Dask = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Play on the workers of this Dask scheduler: tcp://192.168.1.5:8786."),
]


class RunGroup(TyperGroup):
    """A group in which a file may stand in place of a command: it is run."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Insert the command `run` if none is given."""
        if args and args[0] not in self.commands and args[0] not in ("-h", "--help"):
            args = ["run", *args]
        return super().parse_args(ctx, args)


def check_numbers(**given: float | None) -> None:
    """Check options that are numbers, by the names of their parameters.

    Raises:
        TouchlineError: one is not finite.
    """
    for name, value in given.items():
        if value is not None and not math.isfinite(value):
            raise TouchlineError(f"--{name.replace('_', '-')} is {value}; give a number")


def program_of(stdio: str | None, option: str = "--stdio") -> list[str]:
    """The command line of an option, with absolute paths; empty without one.

    Raises:
        TouchlineError: there is no such program.
    """
    if stdio is None:
        return []
    try:
        command = shlex.split(stdio)
    except ValueError as error:
        raise TouchlineError(f"{option} is {stdio}: {error}; close what is open") from None
    check_command_line(option, command)
    return list(command_line(command))


@dataclass(frozen=True)
class MatchOptions:
    """The match of a command: a match file, and the options that replace its keys."""

    changes: Annotated[dict[str, Any], FieldsOf(MatchConfig, "seed", "pace", "duration", name=("match", "name"))]
    officiating: Annotated[dict[str, Any], FieldsOf(OfficiatingConfig, mode="referee")]
    listening: ListenSettings
    file: MatchFile = None
    scene: Scene = None
    profile: Profile = None
    rules: Rules = None

    def read(self, **flags: Any) -> MatchConfig:
        """The match, with further flags; see `read_match`.

        Raises:
            TouchlineError: one line on what is wrong or missing.
        """
        officiating = {f"referee__{key}": value for key, value in self.officiating.items()}
        named = {"scene": self.scene, "profile": self.profile, "rules": self.rules}
        config = read_match(self.file, **named, **self.changes, **officiating, **flags)
        if note := pitch_note(config):
            typer.echo(f"note: {note}", err=True)
        return config


def read_match(file: Path | None, **flags: Any) -> MatchConfig:
    """The match of a file, with flags that override its keys (`record__sights` is the key `record.sights`).

    All requirements of a simulation on this machine are checked here, before any process is launched.

    Raises:
        TouchlineError: one line on what is wrong or missing.
    """
    given = {key.replace("__", "."): value for key, value in flags.items() if value is not None}
    config = load_match(file, given)
    models_of(config, config.load_profile())
    need_pybullet()
    from sim_host.games import game_of_match
    from sim_host.match.live_parameters import LiveParameters
    from sim_host.match.opening import opening_layout

    opening_layout(config, LiveParameters.of(config), game_of_match(config))
    return config


def settings_of(changes: list[str]) -> dict[str, Any]:
    """Key of a match file → value, from texts as `radio.loss=0.2`; a value that is no TOML is text.

    Raises:
        TouchlineError: a text has no key or no value.
    """
    found: dict[str, Any] = {}
    for change in changes:
        key, sign, value = (part.strip() for part in change.partition("="))
        if not sign or not key:
            raise TouchlineError(f'--set is "{change}"; write a key of the match file and its value: radio.loss=0.2')
        if key == "seed":
            raise TouchlineError(f"--set {change}: the seeds are those of --seeds; give them there")
        try:
            found[key] = tomllib.loads(f"value = {value}")["value"]
        except tomllib.TOMLDecodeError:
            found[key] = value
    return found


def pitch_note(config: MatchConfig) -> str | None:
    """Which profile has the pitch that the rule book describes, if the match is played on one of another size."""
    book, pitch = config.load_rule_book(), config.load_profile().field
    if book.profile is None:
        return None
    described = load_profile(book.profile).field
    if (described.length, described.width) == (pitch.length, pitch.width):
        return None
    return (
        f"the rules {book.name} are for a pitch of {described.length:g} × {described.width:g} m, profile "
        f"{config.profile} has {pitch.length:g} × {pitch.width:g} m; --profile {book.profile} fits"
    )


def need_pybullet() -> None:
    """Check that this machine can simulate.

    Raises:
        TouchlineError: a package is missing; the message has the command that installs it.
    """
    if importlib.util.find_spec("pybullet") is None:
        raise TouchlineError(missing_engine_text())


def need_statistics() -> None:
    """Check that this machine can simulate and compute intervals: scipy is part of the extra `sim`, too.

    Raises:
        TouchlineError: a package is missing; the message has the command that installs it.
    """
    need_pybullet()
    need("intervals need scipy, which is not installed", "sim", "scipy")


def selection(include: list[str] | None, exclude: list[str] | None) -> KeySelection:
    """The selection for these key expressions; topics of other files may begin with `/`, keys do not.

    Raises:
        TouchlineError: an expression is invalid.
    """
    chosen = (tuple(one.removeprefix("/") for one in expressions or ()) for expressions in (include, exclude))
    return KeySelection(*chosen)


def check_span(start: float | None, end: float | None) -> None:
    """Check that a span of simulated time has a length.

    Raises:
        TouchlineError: it ends before it begins, or no file has such a time.
    """
    from recordings.reading.recording import is_time

    for option, time in (("--from", start), ("--to", end)):
        if time is not None and not is_time(time):
            raise TouchlineError(f"{option} is {time:g}, which no recording has; give seconds from 0 on")
    if start is not None and end is not None and start >= end:
        raise TouchlineError(f"--from is {start:g} and --to is {end:g}; give a --to that is greater than --from")


def endpoint_of(settings: ListenSettings) -> str | None:
    """The endpoint to listen on, None for the default. Whether it is free is known when the host listens.

    Raises:
        TouchlineError: open to other machines without credentials and without `--insecure`.
    """
    check_protected(settings)
    return settings.listen
