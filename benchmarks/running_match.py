"""A host and its agents as processes, for benchmarks."""

import contextlib
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from schemas.bus.endpoint import with_free_port
from schemas.config.match_config import MatchConfig, load_match
from schemas.side import Side

HERE = Path(__file__).parent


def launch(module: str, *arguments: str) -> subprocess.Popen[bytes]:
    """Run a Python module as a process without output, in the folder of the benchmarks, whose brains it can import."""
    return subprocess.Popen(
        [sys.executable, "-m", module, *arguments], cwd=HERE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )


@contextlib.contextmanager
def running_match(brain: str, overrides: dict[str, Any]) -> Iterator[tuple[MatchConfig, str, subprocess.Popen[bytes]]]:
    """Run a host with an agent process for every robot: yields the match, its endpoint, and the host's process."""
    config = load_match(None, overrides)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "match.json"
        path.write_text(config.model_dump_json())
        host = launch("sim_host", "--listen", endpoint, "--config", str(path))
        there = ("--connect", endpoint, "--match", config.name)
        names = [name for side in Side for name in config.robots(side)]
        agents = [launch("robot_agent", *there, "--robot", name, "--brain", brain) for name in names]
        try:
            yield config, endpoint, host
        finally:
            for process in (host, *agents):
                process.terminate()
            for process in (host, *agents):
                process.wait()
