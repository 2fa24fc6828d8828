"""The processes of a match: one table, and how a match file turns it into programs to launch."""

import sys
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

from schemas.bus.endpoint import is_loopback, local_endpoint
from schemas.config.match_config import MatchConfig, RecordingConfig
from schemas.errors import TouchlineError
from schemas.side import Side


class ProcessKind(StrEnum):
    """What a process is for."""

    HOST = "host"
    RECORDER = "recorder"
    AGENT = "agent"
    PAGE = "page"
    """The coach gateway that serves the match's page."""
    BRIDGES = "bridges"
    """The coach gateway with the match's other bridges."""


@dataclass(frozen=True, slots=True)
class ProcessRow:
    """One kind of process; words in braces are filled in for each match or robot."""

    command: tuple[str, ...]
    environment: dict[str, str] = field(default_factory=dict)
    restarts: int = 0
    """How often a crashed one is started again."""


_PYTHON_MODULE = ("{python}", "-m")
_BUS_OPTIONS = ("--connect", "{connect}", "--match", "{match}")

PROCESSES: dict[ProcessKind, ProcessRow] = {
    ProcessKind.HOST: ProcessRow((*_PYTHON_MODULE, "sim_host", "--listen", "{listen}", "--config", "{config}")),
    ProcessKind.RECORDER: ProcessRow(
        (*_PYTHON_MODULE, "recordings", *_BUS_OPTIONS, "--out", "{recording}", "--config", "{config}")
    ),
    ProcessKind.AGENT: ProcessRow(
        (*_PYTHON_MODULE, "robot_agent", *_BUS_OPTIONS, "--robot", "{robot}", "--brain", "{brain}"),
        environment={
            "TOUCHLINE_CONNECT": "{connect}",
            "TOUCHLINE_MATCH": "{match}",
            "TOUCHLINE_ROBOT": "{robot}",
            "TOUCHLINE_SIDE": "{side}",
            # A brain that goes through a set of words does so in the same order in every run.
            "PYTHONHASHSEED": "0",
        },
        restarts=3,
    ),
    ProcessKind.PAGE: ProcessRow(
        (
            *(*_PYTHON_MODULE, "coach_gateway", *_BUS_OPTIONS, "--web"),
            *("--listen-web", "{address}", "--port", "{port}", "--tokens", "{tokens}"),
        ),
        restarts=3,
    ),
    ProcessKind.BRIDGES: ProcessRow(
        (*_PYTHON_MODULE, "coach_gateway", *_BUS_OPTIONS, "--tokens", "{tokens}"), restarts=3
    ),
}
"""ProcessKind → its row, in the order they are launched."""

TOKENS = "tokens.json"
"""The file of a run's tokens, in its folder."""

COMMON_ENVIRONMENT = {
    "PYTHONUNBUFFERED": "1",
    # A dozen processes share the machine; none of them multiplies matrices worth a thread of their own.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}
"""What every process of a match finds in its environment."""


@dataclass(frozen=True, slots=True)
class Process:
    """One program to launch."""

    name: str
    """Of its log file, and in what is said of it: `host`, `recorder`, or the robot's name."""
    kind: ProcessKind
    command: tuple[str, ...]
    environment: dict[str, str]
    """Laid over the supervisor's own."""
    restarts: int = 0


@dataclass(frozen=True, slots=True)
class PagePlan:
    """Where a page is served, and where its tokens stand."""

    address: str
    """That it is served on, without a port."""
    port: int
    tokens: Path


@dataclass(frozen=True, slots=True)
class MatchPlan:
    """A match that is ready to be launched."""

    config: MatchConfig
    listen: str
    folder: Path
    """Holds `config.json` and the logs."""
    recording: Path | None
    """Where the recording goes, or nothing when none was wanted."""
    warning: str = ""
    """What people should know before the match begins."""
    page: PagePlan | None = None
    """Where the match's page is served; nothing when none was wanted."""
    bridges: tuple[str, ...] = ()
    """What the bridges' gateway is told; nothing when none is wanted."""

    @property
    def connect(self) -> str:
        """Where the processes of this machine reach the host."""
        return local_endpoint(self.listen)

    @property
    def recording_files(self) -> list[Path]:
        """The finished files of the recording: one, or numbered ones."""
        from recordings.container.numbering import files_at

        return files_at(self.recording) if self.recording is not None else []

    @property
    def tokens(self) -> Path:
        """Of page and coach programs alike."""
        return self.folder / TOKENS

    @property
    def config_file(self) -> Path:
        """The match as its processes read it."""
        return self.folder / "config.json"


def check_robot_names(config: MatchConfig) -> None:
    """Make sure that no robot is called like a process that every match may have: logs go by these names.

    Raises:
        TouchlineError: one is.
    """
    taken = [kind.value for kind in ProcessKind if kind is not ProcessKind.AGENT]
    for name in (name for side in Side for name in config.robots(side)):
        if name in taken:
            raise TouchlineError(f'a robot is named "{name}", as a process of the match is; rename it')


def processes_of(plan: MatchPlan) -> list[Process]:
    """All programs of a match, in the order they are launched."""
    values = {
        "python": sys.executable,
        "listen": plan.listen,
        "connect": plan.connect,
        "match": plan.config.name,
        "config": str(plan.config_file),
    }
    open_to_others = () if is_loopback(plan.listen) else ("--insecure",)  # whoever made the plan was told so
    processes = [_process("host", ProcessKind.HOST, values, extra=open_to_others)]
    if plan.recording is not None:
        wanted = _recorder_options(plan.config.record)
        processes.append(
            _process("recorder", ProcessKind.RECORDER, {**values, "recording": str(plan.recording)}, extra=wanted)
        )
    for side in Side:
        team = plan.config.team(side)
        for robot in plan.config.robots(side):
            own = {**values, "robot": robot, "side": side.value, "brain": team.brain or ""}
            processes.append(_process(robot, ProcessKind.AGENT, own, own_command=tuple(team.command or ())))
    if plan.page is not None:
        processes.append(page_process(plan.page, plan.connect, plan.config.name))
    if plan.bridges:
        processes.append(
            _process("bridges", ProcessKind.BRIDGES, {**values, "tokens": str(plan.tokens)}, extra=plan.bridges)
        )
    return processes


def page_process(page: PagePlan, connect: str, match: str) -> Process:
    """The program that serves the page of a match, or of a replay."""
    values = {"python": sys.executable, "connect": connect, "match": match}
    where = {"address": page.address, "port": str(page.port), "tokens": str(page.tokens)}
    return _process("page", ProcessKind.PAGE, {**values, **where})


def _recorder_options(wanted: RecordingConfig) -> tuple[str, ...]:
    """What a recorder is told, as the match file wants it."""
    limits = {
        "split-size": wanted.split_size,
        "split-duration": wanted.split_duration,
        "keep": wanted.keep,
        "snapshot": wanted.snapshot,
    }
    return (
        *(("--sights",) if wanted.sights else ()),
        *(("--no-viz",) if not wanted.viz else ()),
        *(f"--include={expression}" for expression in wanted.include),
        *(f"--exclude={expression}" for expression in wanted.exclude),
        *(f"--{option}={value}" for option, value in limits.items() if value is not None),
    )


def _process(
    name: str,
    kind: ProcessKind,
    values: dict[str, str],
    *,
    own_command: tuple[str, ...] = (),
    extra: tuple[str, ...] = (),
) -> Process:
    row = PROCESSES[kind]
    return Process(
        name=name,
        kind=kind,
        command=own_command or (*(part.format_map(values) for part in row.command), *extra),
        environment={**COMMON_ENVIRONMENT, **{key: value.format_map(values) for key, value in row.environment.items()}},
        restarts=row.restarts,
    )
