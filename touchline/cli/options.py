"""The words that several commands share, and bundles of them: what each is called, means, and does to the match."""

import importlib.util
import re
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from schemas.bus import endpoint as endpoints
from schemas.bus.contract import BusError
from schemas.bus.endpoint import is_loopback, parse_endpoint, with_free_port
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.robot_model import models_of
from schemas.config.rule_book import SHIPPED, load_rule_book
from schemas.errors import TouchlineError
from schemas.side import Side

if TYPE_CHECKING:
    from recordings.container.key_selection import KeySelection

DEFAULT_ENDPOINT = endpoints.DEFAULT_ENDPOINT
DEFAULT_MATCH = "friendly"

MatchFile = Annotated[
    Path | None, typer.Argument(metavar="[MATCH.toml]", help="The match file; without one, a five-a-side friendly.")
]
Seed = Annotated[int | None, typer.Option(help="Whole number that all randomness comes from.")]
Pace = Annotated[str | None, typer.Option(help="lockstep, realtime, or x4 for four times real time.")]
Duration = Annotated[float | None, typer.Option(help="Playing time of all halves in s.")]
Scene = Annotated[str | None, typer.Option(help="Start in this scene, by name or path; touchline scenes lists them.")]
Profile = Annotated[
    str | None, typer.Option(help="Field, bodies and limits: msl, omni, omni3, paper, or the path of a file.")
]
Rules = Annotated[str | None, typer.Option(help=f"Rule book: {', '.join(SHIPPED)}.")]
Referee = Annotated[
    str | None, typer.Option(help="Who decides: automatic, manual, or mixed: it proposes, people may overrule it.")
]
MatchName = Annotated[str | None, typer.Option("--match", "--name", help="Name of the match on the bus.")]
Listen = Annotated[str, typer.Option(help="Endpoint of the host; port 0 picks a free one.")]
Insecure = Annotated[bool, typer.Option("--insecure", help="Let other machines in, without any password.")]
Sights = Annotated[bool, typer.Option("--sights", help="Record what every robot perceives, too.")]
Include = Annotated[
    list[str] | None,
    typer.Option(help="Take these keys alone, as robot/*/command or team/**; may be given several times."),
]
Exclude = Annotated[list[str] | None, typer.Option(help="Leave these keys out; may be given several times.")]
SplitSize = Annotated[float | None, typer.Option(min=0.01, help="MB after which the recording goes on in a next file.")]
SplitDuration = Annotated[
    float | None, typer.Option(min=0.1, help="Simulated s after which the recording goes on in a next file.")
]
Keep = Annotated[int | None, typer.Option(min=1, help="Keep so many files of the recording, the newest.")]
Snapshot = Annotated[
    float | None,
    typer.Option(min=0.1, help="Write the last so many simulated s at each goal and on request, and nothing else."),
]
Web = Annotated[bool, typer.Option("--web", help="Serve a page to watch and command from, and say where.")]
WebPort = Annotated[int, typer.Option(help="Port of the page; 0 takes a free one.")]
ListenWeb = Annotated[str, typer.Option(help="Address to serve the page on; 0.0.0.0 lets other machines see it.")]
NoViz = Annotated[
    bool, typer.Option("--no-viz", help="Leave out what Foxglove, Lichtblick and Rerun draw: /tf and /viz/*.")
]
ForSide = Annotated[Side, typer.Argument(help="cyan or magenta")]
Json = Annotated[bool, typer.Option("--json", help="Print the result as one JSON object.")]

NO_PYBULLET = "the simulation needs PyBullet, which is not installed; pip install 'touchline[sim]'"


def _endpoint(connect: str) -> str:
    parse_endpoint(connect)
    return connect


def match_name(name: str) -> str:
    """The name itself.

    Raises:
        TouchlineError: it is no key chunk.
    """
    if re.fullmatch(r"[a-z][a-z0-9_]{0,31}", name) is None:
        raise TouchlineError(f'--match is "{name}"; a match name is a key chunk: small letters, digits and _')
    return name


Connect = Annotated[str, typer.Option(envvar="TOUCHLINE_CONNECT", callback=_endpoint, help="Endpoint of the host.")]
Match = Annotated[
    str, typer.Option("--match", envvar="TOUCHLINE_MATCH", callback=match_name, help="Name of the match.")
]


@dataclass(frozen=True)
class ConnectOptions:
    """Which running match a command means."""

    connect: Connect = DEFAULT_ENDPOINT
    match: Match = DEFAULT_MATCH


@dataclass(frozen=True)
class MatchOptions:
    """Which match a command plays, and how: a file, and what is said otherwise than it says."""

    file: MatchFile = None
    seed: Seed = None
    pace: Pace = None
    duration: Duration = None
    scene: Scene = None
    profile: Profile = None
    rules: Rules = None
    referee: Referee = None
    name: MatchName = None
    listen: Listen = DEFAULT_ENDPOINT
    insecure: Insecure = False

    def read(self, **flags: Any) -> MatchConfig:
        """The match, with more flags than these; as `read_match`.

        Raises:
            TouchlineError: one line on what is wrong or missing.
        """
        own = {name: getattr(self, name) for name in ("seed", "pace", "duration", "scene", "profile", "rules", "name")}
        return read_match(self.file, **own, referee__mode=self.referee, **flags)

    def endpoint(self) -> str:
        """Where its host listens; as `listening`.

        Raises:
            TouchlineError: open to other machines without `--insecure`, or in use.
        """
        return listening(self.listen, insecure=self.insecure)


def read_match(file: Path | None, **flags: Any) -> MatchConfig:
    """The match of a file with the given flags laid over it (`record__sights` is the key `record.sights`).

    Everything that a simulation on this machine needs is checked here, before anything is launched.

    Raises:
        TouchlineError: one line on what is wrong or missing.
    """
    given = {key.replace("__", "."): value for key, value in flags.items() if value is not None}
    config = load_match(file, given)
    models_of(config, config.load_profile())
    book = load_rule_book(config.rules)
    need_pybullet()
    from sim_host.match.live_parameters import LiveParameters
    from sim_host.match.start_scene import opening_layout

    opening_layout(config, LiveParameters.of(config), book.restarts)
    return config


def need_pybullet() -> None:
    """Make sure that this machine can simulate.

    Raises:
        TouchlineError: with the line that brings what is missing.
    """
    if importlib.util.find_spec("pybullet") is None:
        raise TouchlineError(NO_PYBULLET)


def selection(include: list[str] | None, exclude: list[str] | None) -> "KeySelection":
    """The keys that are meant.

    Raises:
        TouchlineError: an expression that is none.
    """
    from recordings.container.key_selection import KeySelection

    return KeySelection(tuple(include or ()), tuple(exclude or ()))


def listening(listen: str, *, insecure: bool) -> str:
    """The endpoint to listen on, with a real port, after making sure that it may be and can be used.

    Raises:
        TouchlineError: open to other machines without `--insecure`, or in use.
    """
    if not insecure and not is_loopback(listen):
        raise TouchlineError(
            f"--listen {listen} is open to other machines and asks nobody for a password; "
            "add --insecure if that is meant, or listen on tcp/127.0.0.1:7447"
        )
    try:
        endpoint = with_free_port(listen)
        _probe(endpoint)
    except OSError as error:
        raise BusError(
            f"--listen {listen} cannot be listened on ({error.strerror}); "
            "choose another port, or tcp/127.0.0.1:0 for a free one"
        ) from None
    return endpoint


def _probe(endpoint: str) -> None:
    """Bind the address for a moment: two hosts on one port would share their robots."""
    protocol, host, port = parse_endpoint(endpoint)
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    kind = socket.SOCK_DGRAM if protocol in ("udp", "quic") else socket.SOCK_STREAM
    with socket.socket(family, kind) as probe:
        if kind == socket.SOCK_STREAM:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # an old connection's remains do not count
        probe.bind((host, port))
