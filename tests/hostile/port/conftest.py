"""A host with two robots as processes on loopback, for attacks on its port."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from robot_agent.settings import AgentSettings
from schemas.bus.endpoint import with_free_port
from schemas.config.match_config import MatchConfig
from schemas.config.settings import Settings
from schemas.config.settings_file import write_settings
from sim_host.server.settings import HostSettings
from support.process_story import SHORT_LIMIT, Listener, Program

ROBOTS = {"cyan": "cyan1", "magenta": "magenta1"}
BRAIN = """
from schemas.messages.command import Command, Drive

def act(sight):
    return Command(answers_tick=sight.tick, drive=Drive(vx=0.5, omega=1.0))
"""


class Target:
    """The attacked host, its agents, and a client that watches them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._programs: list[Program] = []
        self.endpoint = with_free_port("tcp/127.0.0.1:0")
        teams = {side: {"robots": [robot]} for side, robot in ROBOTS.items()}
        self.config = MatchConfig.model_validate({"name": "besieged", "duration": 80_000, "teams": teams})
        (folder / "mind.py").write_text(BRAIN)
        self.host = self.start("host", "sim_host", HostSettings(config=self.config, listen=self.endpoint))
        for robot in ROBOTS.values():
            agent = AgentSettings(connect=self.endpoint, match="besieged", robot=robot, brain="mind:act", patience=90.0)
            self.start(robot, "robot_agent", agent)
        self.watcher = Listener("besieged", self.endpoint, self.host, every_tick=False, limit=SHORT_LIMIT)

    def start(self, name: str, module: str, settings: Settings) -> Program:
        write_settings(settings, self._folder / f"{name}.json")
        self._programs.append(Program([module, "--settings", f"{name}.json"], self._folder, name, {}))
        return self._programs[-1]

    def attack(self, name: str, seconds: float) -> Program:
        """Start an attack as a process."""
        words = ["support.attacker", name, self.endpoint, self.config.name, str(seconds)]
        path = str(Path(__file__).parents[2])
        self._programs.append(Program(words, self._folder, f"attacker_{name}", {"PYTHONPATH": path}))
        return self._programs[-1]

    def memory_mb(self) -> float:
        """Resident memory of the host."""
        lines = Path(f"/proc/{self.host.popen.pid}/status").read_text().splitlines()
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmRSS"))

    def close(self) -> None:
        self.watcher.bus.close()
        for program in self._programs:
            program.end()


@pytest.fixture(scope="module")
def target(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Target]:
    made = Target(tmp_path_factory.mktemp("besieged"))
    made.watcher.until_tick(50)
    yield made
    made.close()


@pytest.fixture
def attack(target: Target) -> Callable[..., Program]:
    """Carries an attack out to its end, while the match has to go on; returns the attacker's process."""

    def carry_out(name: str, seconds: float = 1.0) -> Program:
        attacker = target.attack(name, seconds)
        attacker.popen.wait(SHORT_LIMIT)
        target.watcher.for_ticks(20)
        return attacker

    return carry_out
