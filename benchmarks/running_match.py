"""A host and its agents as processes, for benchmarks."""

import contextlib
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from robot_agent.process.settings import AgentSettings
from runtime.access.accounts import Account
from runtime.access.certificates import make_certificate
from runtime.access.credentials import HOST_FILE, account_file, new_credentials, write_credentials
from runtime.bus.endpoint import with_free_port
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.settings import Settings
from schemas.side import Side
from sim_host.server.settings import HostSettings

HERE = Path(__file__).parent
ACCESS = ("none", "credentials", "tls")
"""How a host is protected."""
PATIENCE_S = 90.0
"""Wall time for the start of all processes, s."""


def launch(module: str, settings: Settings, stdout: int = subprocess.DEVNULL) -> subprocess.Popen[bytes]:
    """Run a process with these settings in the folder of the benchmarks, whose brains it can import."""
    process = subprocess.Popen(
        [sys.executable, "-m", module, "--settings", "-"],
        cwd=HERE,
        stdin=subprocess.PIPE,
        stdout=stdout,
        stderr=subprocess.DEVNULL,
    )
    assert process.stdin is not None
    process.stdin.write(settings.model_dump_json().encode())
    process.stdin.close()
    return process


class RunningMatch(NamedTuple):
    """A match and its processes."""

    config: MatchConfig
    endpoint: str
    host: subprocess.Popen[bytes]
    agents: list[subprocess.Popen[bytes]]
    viewer: Path | None = None
    """Credentials of a viewer; None for a host that admits everybody."""


@contextlib.contextmanager
def running_match(brain: str, overrides: dict[str, Any], access: str = "none") -> Iterator[RunningMatch]:
    """Run a host with an agent process for every robot."""
    config = load_match(None, overrides)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) if access != "none" else None
        if folder is not None:
            write_credentials(folder, new_credentials(certificate=make_certificate() if access == "tls" else None))
        files = {account: account_file(folder, account) if folder is not None else None for account in Account}
        own = folder / HOST_FILE if folder is not None else None
        host = launch("sim_host", HostSettings(config=config, listen=endpoint, credentials=own))
        join = {"connect": endpoint, "match": config.name, "brain": brain, "patience": PATIENCE_S}
        agents = [
            launch("robot_agent", AgentSettings(robot=robot, credentials=files[Account.of_team(side)], **join))
            for side in Side
            for robot in config.robots(side)
        ]
        with _ended((host, *agents)):
            yield RunningMatch(config, endpoint, host, agents, files[Account.VIEWER])


@contextlib.contextmanager
def _ended(processes: Sequence[subprocess.Popen[bytes]]) -> Iterator[None]:
    """End processes after the block."""
    try:
        yield
    finally:
        for process in processes:
            process.terminate()
        for process in processes:
            process.wait()
