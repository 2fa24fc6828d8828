"""The kinds of process of a match, and one program to launch."""

import socket
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType

from schemas.config.settings import Settings
from touchline.launch.confinement.robot_confinement import Confinement
from touchline.launch.processes.python_process import PYTHON, module_path_environment


class ProcessKind(StrEnum):
    """The role of a process."""

    HOST = "host"
    RECORDER = "recorder"
    AGENT = "agent"
    PAGE = "page"
    """The coach gateway that serves the match's page."""
    BRIDGES = "bridges"
    """The coach gateway with the match's other bridges."""


@dataclass(frozen=True, slots=True)
class ProcessRow:
    """One kind of process."""

    module: str
    """Started as `python -P -m MODULE --settings FILE`."""
    restarts: int = 0
    """Maximum number of restarts after crashes."""


PROCESSES: dict[ProcessKind, ProcessRow] = {
    ProcessKind.HOST: ProcessRow("sim_host"),
    ProcessKind.RECORDER: ProcessRow("recordings", restarts=3),
    ProcessKind.AGENT: ProcessRow("robot_agent", restarts=3),
    ProcessKind.PAGE: ProcessRow("coach_gateway", restarts=3),
    ProcessKind.BRIDGES: ProcessRow("coach_gateway", restarts=3),
}
"""ProcessKind → its row, in the order they are launched."""

COMMON_ENVIRONMENT = {
    "PYTHONUNBUFFERED": "1",
    # A dozen processes share the machine; their matrices are too small to profit from threads.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}
"""Environment of every process of a match."""


@dataclass(frozen=True, slots=True)
class Process:
    """One program to launch."""

    name: str
    """Name in messages and of the log file: `host`, `recorder`, or the robot's name."""
    kind: ProcessKind
    command: tuple[str, ...]
    environment: dict[str, str]
    """Added to the supervisor's environment, or to what the confinement leaves of it."""
    restarts: int = 0
    settings: Settings | None = None
    """The content of `settings_file`; None for a team's own program."""
    settings_file: Path | None = None
    sockets: tuple[socket.socket, ...] = ()
    """Bound sockets that it inherits, also when it is started again."""
    confinement: Confinement | None = None
    """How a robot's program is confined; None for the programs of this library, which are not."""

    @property
    def can_fork(self) -> bool:
        """Whether it may be forked from the robots' server: it runs this library's code, with no view of its own."""
        return (
            self.kind is ProcessKind.AGENT
            and self.settings is not None
            and (self.confinement is None or not self.confinement.is_isolated)
        )


def library_process(
    name: str,
    kind: ProcessKind,
    settings: Settings,
    folder: Path,
    environment: Mapping[str, str] = MappingProxyType({}),
    sockets: tuple[socket.socket, ...] = (),
    module: str | None = None,
) -> Process:
    """A program of this library, with the settings that it reads from its file in `folder`.

    `module` is another one than that of its kind.
    """
    row, file = PROCESSES[kind], folder / f"{name}.json"
    command = (*PYTHON, "-m", module or row.module, "--settings", str(file))
    whole = {**COMMON_ENVIRONMENT, **module_path_environment(), **environment}
    return Process(name, kind, command, whole, row.restarts, settings, file, sockets)
