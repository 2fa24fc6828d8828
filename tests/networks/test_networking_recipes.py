"""The commands of docs/networking.md, run as they are printed: each machine is a network namespace with its own folder.

A match lasts 2 s at four times real time, of one robot against two, where the page has 60 s in real time; 40 s where a
coach and a recorder have to come before its end. Only the machine of the host has the packages of the extras.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from support.brisk import BRISK
from support.namespaces import Network, network
from support.process_story import SHORT_LIMIT, wait_for

pytestmark = pytest.mark.processes

ROOT = Path(__file__).parents[2]
RECIPES = (ROOT / "docs" / "networking.md").read_text("utf-8").partition("\n## What a firewall must let through")[0]
MACHINES = ("host", "cyan", "magenta", "coach", "recorder")
ROBOTS = ["cyan1", "magenta1", "magenta2"]
SMALL = f'rules = "{BRISK}"\n[teams.cyan]\nsize = 1\n[teams.magenta]\nsize = 2\n'
LASTING = ("match", "host", "team", "agent", "record")
"""Commands that run until the match is over."""
EXTRAS = ("pybullet", "starlette", "uvicorn", "trustme", "foxglove")
"""Packages that robots, coaches and recorders on other machines do not have."""
READY = {
    "match": "waiting for magenta",
    "host": "on t",  # match "friendly" on tcp/…
    "record": "",
    "team": "started; logs",
    "agent": "",
}
"""Command → words in its output after which the next command is typed; empty for at once."""


def sections() -> dict[str, list[str]]:
    """Heading → lines of its shell commands."""
    found = {}
    for part in RECIPES.split("\n## ")[1:]:
        pieces = re.findall(r"^```sh\n(.*?)^```$", part, re.DOTALL | re.MULTILINE)
        found[part.splitlines()[0]] = "".join(pieces).splitlines()
    return {heading: lines for heading, lines in found.items() if lines}


class Lab:
    """The machines of a recipe: a folder each, and the programs that were started on them."""

    def __init__(self, net: Network, folder: Path) -> None:
        self.net, self.folder, self.duration = net, folder, "2"
        self.programs: list[tuple[str, Path, subprocess.Popen[bytes]]] = []
        for machine in net.names:
            (folder / machine).mkdir()
        (folder / "host" / "small.toml").write_text(SMALL)
        self._without = folder / "without"
        self._without.mkdir()
        for package in EXTRAS:
            (self._without / f"{package}.py").write_text(f"raise ModuleNotFoundError(name={package!r})\n")

    def type(self, line: str, machine: str) -> None:
        """Run one line on a machine: to its end, or until it is ready where it lasts as long as the match."""
        if line.startswith("scp "):
            source, target = line.split()[1:]
            (file,) = (self.folder / machine).glob(source)
            shutil.copy(file, self.folder / target.rstrip(":"))
            return
        words = shlex.split(line)
        assert words[0] == "touchline", f"a recipe has other commands than touchline and scp: {line}"
        if words[1] in ("match", "host"):
            words.insert(2, "small.toml")
            words[words.index("--duration") + 1] = self.duration
            words[words.index("--pace") + 1] = "x4"
        log = self.folder / machine / f"program{len(self.programs)}.out"
        folder = self.folder / machine
        path = str(ROOT) if machine == "host" else f"{self._without}{os.pathsep}{ROOT}"
        environment = {**os.environ, "XDG_RUNTIME_DIR": str(folder), "COLUMNS": "200", "PYTHONPATH": path}
        with log.open("wb") as out:
            program = self.net.run(
                machine,
                [sys.executable, "-P", "-m", *words],
                cwd=folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
            )
        if words[1] not in LASTING:
            assert program.wait(SHORT_LIMIT) == 0, f"{line}: {log.read_text()}"
            return
        self.programs.append((line, log, program))
        if words[1] != "match" or "--remote" in words:
            ready = READY[words[1]]
            wait_for(
                lambda: ready in log.read_text() or program.poll() is not None,
                f"{line}: {log.read_text()}",
                SHORT_LIMIT,
            )

    def finish(self) -> dict[str, str]:
        """Wait until all programs have ended with status 0; command → its output."""
        for line, log, program in self.programs:
            if " agent " in line:  # the host, typed before, has ended; the agent would wait for its return
                program.terminate()
            assert program.wait(SHORT_LIMIT) == 0, f"{line}: {log.read_text()}"
        return {shlex.split(line)[1]: log.read_text() for line, log, _ in self.programs}


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    with network(*MACHINES) as net:
        yield Lab(net, tmp_path)


def follow(lab: Lab, heading: str) -> dict[str, str]:
    machine = ""
    for line in sections()[heading]:
        if line.startswith("# on "):
            machine = line.removeprefix("# on ")
        else:
            lab.type(line, machine)
    return lab.finish()


def robots_that_answered(file: Path) -> list[str]:
    """Robots of a recorded match whose commands the host has received."""
    health = [message for _, message in open_recording(file).decoded("host/health")][-1]
    return sorted(name for name, robot in health.robots.items() if robot.answers)


def test_every_recipe_is_run_by_a_test() -> None:
    assert list(sections()) == ["One machine", "Two machines", "Every part on its own machine", "Encrypted"]


def test_a_match_on_one_machine(lab: Lab) -> None:
    assert "full time" in follow(lab, "One machine")["match"]


def test_a_match_whose_other_team_comes_from_a_second_machine(lab: Lab) -> None:
    printed = follow(lab, "Two machines")
    command = next(line for line in sections()["Two machines"] if line.startswith("touchline team"))
    joined = next(line for line in printed["match"].splitlines() if "joins with" in line)
    assert joined.partition("with: ")[2].split() == [*command.split()[:-1], "MODULE:CLASS"]
    assert "joined: 2 of 2 robots of magenta are there" in printed["match"]
    assert "full time" in printed["match"]
    (file,) = (lab.folder / "host").glob("runs/*/match.mcap")
    assert robots_that_answered(file) == ROBOTS


def test_host_both_teams_coach_and_recorder_on_a_machine_each(lab: Lab) -> None:
    lab.duration = "40"  # 10 s of wall time, in which the process of the coach has to start and connect
    printed = follow(lab, "Every part on its own machine")
    assert "match over" in printed["host"]
    file = lab.folder / "recorder" / "final.mcap"
    recording = open_recording(file)
    assert recording.result is not None
    assert recording.result.tick >= 2 / 0.02
    assert robots_that_answered(file) == ROBOTS


def test_an_encrypted_match(lab: Lab) -> None:
    pytest.importorskip("trustme")
    assert "match over" in follow(lab, "Encrypted")["host"]
