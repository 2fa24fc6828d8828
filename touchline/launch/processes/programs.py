"""The processes of a match: the programs to launch for a match file."""

import socket
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from coach_gateway.settings import NO_BRIDGES, BridgeOptions, GatewaySettings
from coach_gateway.web.settings import WebSettings
from recordings.recorder.settings import RecorderSettings
from robot_agent.process.settings import AgentSettings
from runtime.access.accounts import Account
from runtime.access.credentials import HOST_FILE, account_file
from runtime.bus.endpoint import is_loopback, local_endpoint
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side
from sim_host.server.settings import HostSettings
from touchline.launch.confinement.robot_confinement import Confinement, team_confinements
from touchline.launch.confinement.team_code import team_program
from touchline.launch.processes.process_table import Process, ProcessKind, library_process
from touchline.launch.processes.robot_process import robot_process

OUTCOME = "outcome.json"
"""The file of a match's result, in the folder of its run."""
CREDENTIALS = "credentials"
"""The folder of a run's credentials, in its folder."""
ANNOUNCEMENT = "endpoint.json"
"""The file in which the host of a run announces its endpoint, in the run's folder."""
TOKENS = "tokens.json"
"""The file of a run's tokens, in its folder."""
_RESULT = "result"
"""The folder with what the match's page shows after the match, in that of its run."""


@dataclass(frozen=True, slots=True)
class Page:
    """A page to be served."""

    settings: WebSettings
    listener: socket.socket
    """A browser that connects before the page is served waits."""


@dataclass(frozen=True, slots=True)
class MatchPlan:
    """A match ready to launch."""

    config: MatchConfig
    listen: str | None
    """The endpoint to listen on, with port 0 for a free one; None for the default. Where the host listens, once it
    does."""
    folder: Path
    """Holds the settings and the logs of all processes."""
    recording: Path | None
    """The recording to write; None for no recording."""
    warning: str = ""
    """A warning to print before the match begins; empty for none."""
    page: Page | None = None
    """The match's page; None for no page."""
    bridges: BridgeOptions = NO_BRIDGES
    """The bridges besides the page."""
    brain_folder: Path | None = None
    """Folder in which brains are looked for before the current directory: the match file's."""
    bridge_sockets: tuple[socket.socket, ...] = ()
    """The bound sockets of the bridges, in the order in which they are inherited."""
    launch_token: str | None = None
    """Secret by which the host knows the agents of this launch; None admits every agent."""
    confinements: Mapping[Side, Confinement] | None = None
    """How the robots of each side are confined; None to find out when they are launched."""
    reload: bool = False
    """Robots whose code has changed get new brains between two episodes."""
    isolation_note: str = ""
    """What the teams are not isolated from; empty for nothing to be printed."""
    credentials: Path | None = None
    """Folder with the credentials of the host and of all accounts; None admits everybody."""

    @property
    def connect(self) -> str:
        """The endpoint for processes on the same machine of a host that listens."""
        assert self.listen is not None
        return local_endpoint(self.listen)

    def credentials_of(self, account: Account) -> Path | None:
        """The credentials of an account; None in a match that admits everybody."""
        return account_file(self.credentials, account) if self.credentials is not None else None

    @property
    def announcement(self) -> Path:
        """The file in which the host announces its endpoint."""
        return self.folder / ANNOUNCEMENT

    @property
    def outcome(self) -> Path:
        """The file in which the host leaves the result."""
        return self.folder / OUTCOME

    @property
    def tokens(self) -> Path:
        """The file of the tokens for both page and coach programs."""
        return self.folder / TOKENS

    @property
    def result_folder(self) -> Path:
        """The folder with what the match's page shows after the match."""
        return self.folder / _RESULT


def check_robot_names(config: MatchConfig) -> None:
    """Check that no robot has the name of another process or a file of the match: its log and its folder have its name.

    Raises:
        TouchlineError: a robot has such a name.
    """
    taken = [kind.value for kind in ProcessKind if kind is not ProcessKind.AGENT]
    taken += [Path(name).stem for name in (OUTCOME, CREDENTIALS, ANNOUNCEMENT, TOKENS, _RESULT)]
    taken += [side.value for side in Side if side.value in config.processes(side)]
    for name in (name for side in Side for name in config.robots(side)):
        if name in taken:
            raise TouchlineError(f'a robot is named "{name}", as a process or a file of the match is; rename it')


def host_process(plan: MatchPlan) -> Process:
    """The host of a match, which is launched first."""
    host = HostSettings(
        config=plan.config,
        listen=plan.listen,
        credentials=plan.credentials / HOST_FILE if plan.credentials is not None else None,
        # --insecure was checked when the plan was made
        insecure=plan.credentials is None and plan.listen is not None and not is_loopback(plan.listen),
        launch_token=plan.launch_token,
        admit=[ProcessKind.RECORDER.value] if plan.recording is not None else [],
        announcement=plan.announcement,
        outcome=plan.outcome,
    )
    return library_process("host", ProcessKind.HOST, host, plan.folder)


def client_processes(plan: MatchPlan) -> list[Process]:
    """The other programs of a match, whose host listens, in the order they are launched."""
    config, folder = plan.config, plan.folder
    connect, match = plan.connect, config.name
    processes = []
    if plan.recording is not None:
        recorder = RecorderSettings(
            connect=connect,
            match=match,
            credentials=plan.credentials_of(Account.RECORDER),
            out=plan.recording,
            record=config.record,
            config=config,
        )
        processes.append(library_process("recorder", ProcessKind.RECORDER, recorder, folder))
    confinements = plan.confinements or team_confinements(config, plan.brain_folder, folder.parent)
    for side in config.local_sides:
        processes += [
            _process_of(name, robots, side, plan, confinements[side].in_folder(folder / name))
            for name, robots in config.processes(side).items()
        ]
    operator = plan.credentials_of(Account.OPERATOR)  # a gateway officiates, and gives the orders of both coaches
    gateway = GatewaySettings(connect=connect, match=match, credentials=operator, tokens=plan.tokens)
    if plan.page is not None:
        settings = gateway.model_copy(update={"web": plan.page.settings, "result": plan.result_folder})
        processes.append(library_process("page", ProcessKind.PAGE, settings, folder, sockets=(plan.page.listener,)))
    if plan.bridges.wanted:
        bridges = gateway.model_copy(update={"bridges": plan.bridges})
        processes.append(library_process("bridges", ProcessKind.BRIDGES, bridges, folder, sockets=plan.bridge_sockets))
    return processes


def _process_of(name: str, robots: Sequence[str], side: Side, plan: MatchPlan, confinement: Confinement) -> Process:
    """The process of one robot of a match, or of all robots of a side."""
    team = plan.config.team(side)
    program = team_program(plan.config, side, plan.brain_folder)
    settings = AgentSettings(
        connect=plan.connect,
        match=plan.config.name,
        credentials=plan.credentials_of(Account.of_team(side)),
        robot=robots[0],
        mates=list(robots[1:]),
        brain=team.brain or "",
        stdio=list(program) if team.stdio else [],
        brain_folder=plan.brain_folder,
        recording=plan.recording,
        reload=plan.reload and not team.stdio,
        launch_token=plan.launch_token,
    )
    return robot_process(name, settings, side, program if team.command else (), plan.folder, confinement)
