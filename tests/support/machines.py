"""A match in real time whose processes are on machines of their own, in network namespaces."""

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from robot_agent.process.settings import AgentSettings
from schemas.config.match_config import load_match
from schemas.config.settings import Settings
from sim_host.server.settings import HostSettings
from support.namespaces import Network, network
from support.process_story import SHORT_LIMIT, Listener, Program
from support.tunnel import Tunnel

PORT = 7447
MATCH = "faults"
BRAIN = """
import os

from schemas.messages.command import Command, Drive

SPEED = float(os.environ.get("SPEED", "0.6"))


def act(sight):
    return Command(answers_tick=sight.tick, drive=Drive(vx=SPEED, omega=SPEED))
"""
"""Drives in circles."""


class Machines:
    """Starts, stops and watches the processes of one match on the machines of a network."""

    def __init__(self, net: Network, folder: Path, **match: Any) -> None:
        """`match` overrides settings of the match; the host is to be on the machine `host`."""
        self.net = net
        self.folder = folder
        self._endpoint = f"tcp/{net.address('host')}:{PORT}"
        teams = {f"teams.{side}.robots": [f"{side}1"] for side in ("cyan", "magenta")}
        self._overrides = {
            "name": MATCH,
            "pace": "realtime",
            "duration": 80_000.0,
            "referee.mode": "manual",
            **teams,
            **match,
        }
        self._count = 0
        self.python_path = os.environ.get("PYTHONPATH", "")
        """In which the processes find their modules."""
        self.programs: dict[str, Program] = {}
        self._tunnel = Tunnel(lambda: net.connect("host", net.address("host"), PORT))
        self._listeners: list[Listener] = []
        (folder / "circles.py").write_text(BRAIN)

    def start_host(self) -> Program:
        """Start the host, also in place of an earlier one."""
        config = load_match(None, self._overrides)
        return self._start(
            "host", "host", "sim_host", HostSettings(config=config, listen=self._endpoint, insecure=True)
        )

    def start_agent(
        self, robot: str, machine: str, patience: float = 10.0, brain: str = "circles:act", **environment: str
    ) -> Program:
        """Start a robot; by default it drives in circles, with SPEED at that speed in m/s."""
        settings = AgentSettings(connect=self._endpoint, match=MATCH, robot=robot, brain=brain, patience=patience)
        return self._start(robot, machine, "robot_agent", settings, **environment)

    def listen(self) -> Listener:
        """A client of the host that no fault of a cable concerns."""
        endpoint = f"tcp/127.0.0.1:{self._tunnel.port}"
        self._listeners.append(Listener(MATCH, endpoint, self.programs["host"], limit=SHORT_LIMIT))
        return self._listeners[-1]

    def kill(self, name: str) -> None:
        """Kill a process, and wait until it is gone."""
        self.programs[name].popen.kill()
        self.programs[name].popen.wait(SHORT_LIMIT)

    def suspend(self, *names: str) -> None:
        """Stop processes, which keep their connections."""
        for name in names:
            os.kill(self.programs[name].popen.pid, signal.SIGSTOP)

    def resume(self, *names: str) -> None:
        """Let them go on."""
        for name in names:
            os.kill(self.programs[name].popen.pid, signal.SIGCONT)

    def close(self) -> None:
        """End all processes and listeners."""
        for listener in self._listeners:
            listener.bus.close()
        self._tunnel.close()
        for program in self.programs.values():
            program.end()

    def _start(self, name: str, machine: str, module: str, settings: Settings, **environment: str) -> Program:
        self._count += 1
        label = f"{name}-{self._count}"
        file = self.folder / f"{label}.json"
        file.write_text(settings.model_dump_json())
        prefix = self.net.command(machine, [])
        program = Program([module, "--settings", str(file)], self.folder, label, environment, prefix)
        self.programs[name] = program
        return program


@contextmanager
def machines(names: tuple[str, ...], folder: Path, **match: Any) -> Iterator[Machines]:
    """Machines with these names and no process yet; all ends with the block."""
    with network(*names) as net:
        made = Machines(net, folder, **match)
        try:
            yield made
        finally:
            made.close()
