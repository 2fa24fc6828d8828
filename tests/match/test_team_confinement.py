"""The robots that `touchline team` starts are confined to this machine as those of `touchline match`."""

import os
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from support.brisk import BRISK
from support.isolated_match import HEAD, needs_bubblewrap
from support.process_story import SHORT_LIMIT, Program, wait_for

pytestmark = pytest.mark.processes

CUP = f"""
name = "cup"
duration = 1
rules = "{BRISK}"
[teams]
magenta = {{ remote = true, size = 1 }}
[teams.cyan]
size = 1
"""
BRAIN = """
import resource

class Brain(Quiet):
    def begin(self):
        print("secrets", [name for name in os.environ if name.startswith("AWS")], flush=True)
        print("model", os.environ.get("MODEL"), flush=True)
        print("folder", os.getcwd(), os.environ["HOME"], flush=True)
        print("files", resource.getrlimit(resource.RLIMIT_NOFILE)[0], flush=True)
        for path in (Path("secret.txt"), Path.home().parents[3] / "secret.txt"):
            try:
                print("read", path.read_text(), flush=True)
            except OSError:
                print("refused", path.name, flush=True)
"""
Start = Callable[..., Program]


@pytest.fixture
def start(open_folder: Path) -> Iterator[Start]:
    """Starts `touchline team magenta` with a brain of its own in a match that waits for it.

    `container` makes the beginning of its command line of what the match has printed.
    """
    (open_folder / "cup.toml").write_text(CUP)
    (open_folder / "guests").mkdir()
    (open_folder / "guests" / "team.py").write_text(HEAD + BRAIN)
    (open_folder / "secret.txt").write_text("secret")
    environment = {"XDG_RUNTIME_DIR": str(open_folder), "COLUMNS": "200", "AWS_SECRET": "hush", "MODEL": "small"}
    match = Program(
        ["touchline", "match", "cup.toml", "--no-record", "--listen", "tcp/127.0.0.1:0"],
        open_folder,
        "match",
        environment,
    )
    programs = [match]

    def start_team(*words: str, container: Callable[[str], list[str]] = lambda _: []) -> Program:
        wait_for(lambda: "waiting for magenta" in match.out, f"{match.out} {match.err}", SHORT_LIMIT)
        prefix = container(match.out)
        (endpoint,) = re.findall(r"--connect (\S+)", match.out)
        words = ("touchline", "team", "magenta", "--connect", endpoint, *words)
        programs.append(Program(list(words), open_folder / "guests", "team", environment, prefix))
        assert programs[-1].status() == 0, (programs[-1].out, programs[-1].err)
        match.status()
        return programs[-1]

    yield start_team
    for program in programs:
        program.end()


def log_of(folder: Path) -> list[str]:
    """What the robot has printed, of the team that was started in this folder."""
    (run,) = (folder / "runs").iterdir()
    return (run / "magenta1.log").read_text().splitlines()


def test_a_team_s_robot_has_a_chosen_environment_a_folder_of_its_own_and_limits(start: Start) -> None:
    """It joins with the credentials that the match on this machine has announced."""
    team = start("--brain", "team:Brain", "--open-files", "200", "--pass-environment", "MODEL")
    log = log_of(team.folder)
    assert "secrets []" in log and "model small" in log and "files 200" in log
    (folder,) = (line.split()[1:] for line in log if line.startswith("folder "))
    assert folder[0] == folder[1] and folder[0].endswith("/magenta1")
    assert "read secret" in log  # which isolation prevents
    assert "robots run as your user: they can read your files and signal your processes" in team.err + team.out


@needs_bubblewrap()
def test_in_bubblewrap_a_team_s_robot_reads_its_team_s_folder_and_nothing_else_of_the_user(start: Start) -> None:
    team = start("--brain", "team:Brain", "--isolate", "bubblewrap")
    log = log_of(team.folder)
    assert "read secret" not in log and log.count("refused secret.txt") == 2
    assert "robots run as your user" not in team.err + team.out


@needs_bubblewrap()
def test_a_team_plays_in_a_container_that_has_its_code_its_credentials_and_a_folder_for_logs(
    start: Start, open_folder: Path
) -> None:
    """The recipe for rivals; bubblewrap takes the place of a container's engine."""

    def container(printed: str) -> list[str]:
        (credentials,) = re.findall(r"give it its credentials, and no other file: (\S+)", printed)
        (open_folder / "logs").mkdir()
        visible = (("--ro-bind", open_folder / "guests", "/tmp/team"), ("--bind", open_folder / "logs", "/tmp/logs"))
        installed = (sys.prefix, Path(__file__).parents[2])  # which may be in /tmp
        return [
            *("bwrap", "--unshare-all", "--share-net", "--cap-drop", "ALL", "--die-with-parent"),
            *("--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc", "--tmpfs", "/tmp"),
            *(str(word) for folder in installed for word in ("--ro-bind", folder, folder)),
            *(str(word) for words in visible for word in words),
            *("--ro-bind", str(open_folder / credentials), "/tmp/credentials.json", "--chdir", "/tmp/logs"),
            *("--clearenv", "--setenv", "PATH", os.defpath, "--setenv", "PYTHONPATH", "/tmp/team", "--"),
        ]

    start("--credentials", "/tmp/credentials.json", "--brain", "team:Brain", container=container)
    log = log_of(open_folder / "logs")
    assert "secrets []" in log and "refused secret.txt" in log and "model None" in log
