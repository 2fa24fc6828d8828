"""A host and its agents as processes, for benchmarks."""

import contextlib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from robot_agent.settings import AgentSettings
from schemas.bus.endpoint import with_free_port
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.settings import Settings
from schemas.side import Side
from sim_host.server.settings import HostSettings

HERE = Path(__file__).parent
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


@contextlib.contextmanager
def running_match(brain: str, overrides: dict[str, Any]) -> Iterator[RunningMatch]:
    """Run a host with an agent process for every robot."""
    config = load_match(None, overrides)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    host = launch("sim_host", HostSettings(config=config, listen=endpoint))
    names = [name for side in Side for name in config.robots(side)]
    agents = [
        launch(
            "robot_agent",
            AgentSettings(connect=endpoint, match=config.name, robot=name, brain=brain, patience=PATIENCE_S),
        )
        for name in names
    ]
    try:
        yield RunningMatch(config, endpoint, host, agents)
    finally:
        for process in (host, *agents):
            process.terminate()
        for process in (host, *agents):
            process.wait()
