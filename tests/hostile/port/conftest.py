"""A host with two robots as processes on loopback, for attacks on its port."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from robot_agent.process.settings import AgentSettings
from runtime.access.accounts import Account
from runtime.access.credentials import HOST_FILE, account_file, new_credentials, write_credentials
from runtime.bus.endpoint import with_free_port
from runtime.process.settings_file import write_settings
from schemas.config.match_config import MatchConfig
from schemas.config.settings import Settings
from sim_host.server.settings import HostSettings
from support.process_story import SHORT_LIMIT, Listener, Program

ROBOTS = {"cyan": ["cyan1"], "magenta": ["magenta1"]}
BRAIN = """
import time
from schemas.messages.command import Command, Drive

def act(sight):
    time.sleep(0.005)
    return Command(answers_tick=sight.tick, drive=Drive(vx=0.5, omega=1.0))
"""
"""It thinks for a while: a match as fast as it can be takes both cores from other tests, as long as this one waits."""


class Target:
    """The attacked host, its agents, and a client that watches them."""

    def __init__(self, folder: Path, robots: Mapping[str, list[str]], credentials: Path | None = None) -> None:
        """With a folder of credentials, the host asks for them."""
        self._folder = folder
        self._credentials = credentials
        self._programs: list[Program] = []
        self.endpoint = with_free_port("tcp/127.0.0.1:0")
        teams = {side: {"robots": names} for side, names in robots.items()}
        self.config = MatchConfig.model_validate({"name": "besieged", "duration": 80_000, "teams": teams})
        (folder / "mind.py").write_text(BRAIN)
        own = credentials / HOST_FILE if credentials is not None else None
        settings = HostSettings(config=self.config, listen=self.endpoint, credentials=own)
        self.host = self.start("host", "sim_host", settings)
        for side, names in robots.items():
            for robot in names:
                join = {"connect": self.endpoint, "match": "besieged", "robot": robot, "patience": 90.0}
                agent = AgentSettings(brain="mind:act", credentials=self.file_of(Account(side)), **join)
                self.start(robot, "robot_agent", agent)
        self.watcher = Listener("besieged", self.endpoint, self.host, every_tick=False, limit=SHORT_LIMIT)

    def start(self, name: str, module: str, settings: Settings) -> Program:
        write_settings(settings, self._folder / f"{name}.json")
        self._programs.append(Program([module, "--settings", f"{name}.json"], self._folder, name, {}))
        return self._programs[-1]

    def file_of(self, account: Account) -> Path | None:
        """The credentials of an account; None where the host asks for none."""
        return account_file(self._credentials, account) if self._credentials is not None else None

    def attack(self, name: str, seconds: float, account: Account | None = None) -> Program:
        """Start an attack as a process, with the credentials of an account."""
        words = ["support.attacker", name, self.endpoint, self.config.name, str(seconds)]
        words += [str(self.file_of(account))] if account is not None else []
        path = str(Path(__file__).parents[2])
        self._programs.append(Program(words, self._folder, f"attacker_{name}", {"PYTHONPATH": path}))
        return self._programs[-1]

    def memory_mb(self) -> float:
        """Resident memory of the host."""
        lines = Path(f"/proc/{self.host.popen.pid}/status").read_text().splitlines()
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmRSS"))

    def memory_mb_or(self, default: float) -> float:
        """The same; the default where the host has ended meanwhile."""
        try:
            return self.memory_mb()
        except (OSError, StopIteration):
            return default

    def close(self) -> None:
        self.watcher.bus.close()
        for program in self._programs:
            program.end()


@pytest.fixture(scope="module")
def target(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Target]:
    made = Target(tmp_path_factory.mktemp("besieged"), ROBOTS)
    made.watcher.until_tick(50)
    yield made
    made.close()


@pytest.fixture(scope="module")
def guarded_target(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Target]:
    """A host with credentials; cyan has two robots."""
    folder = tmp_path_factory.mktemp("credentials")
    write_credentials(folder, new_credentials())
    made = Target(tmp_path_factory.mktemp("guarded"), {**ROBOTS, "cyan": ["cyan1", "cyan2"]}, folder)
    made.watcher.until_tick(50)
    yield made
    made.close()
