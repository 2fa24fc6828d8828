"""The robots that `touchline team` starts are confined to this machine as those of `touchline match`."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from support.isolated_match import HEAD, needs_bubblewrap
from support.process_story import SHORT_LIMIT, Program, wait_for

pytestmark = pytest.mark.processes

CUP = """
name = "cup"
duration = 4
[teams]
magenta = { remote = true, size = 1 }
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

class Greedy(Quiet):
    def begin(self):
        self.all = bytearray(3_000_000_000)
"""
Start = Callable[..., Program]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts `touchline team magenta` with a brain of its own in a match that waits for it."""
    (tmp_path / "cup.toml").write_text(CUP)
    (tmp_path / "guests").mkdir()
    (tmp_path / "guests" / "team.py").write_text(HEAD + BRAIN)
    (tmp_path / "secret.txt").write_text("secret")
    environment = {"XDG_RUNTIME_DIR": str(tmp_path), "COLUMNS": "200", "AWS_SECRET": "hush", "MODEL": "small"}
    match = Program(
        ["touchline", "match", "cup.toml", "--no-record", "--listen", "tcp/127.0.0.1:0"], tmp_path, "match", environment
    )
    programs = [match]

    def start_team(*words: str) -> Program:
        wait_for(lambda: "waiting for magenta" in match.out, f"{match.out} {match.err}", SHORT_LIMIT)
        programs.append(Program(["touchline", "team", "magenta", *words], tmp_path / "guests", "team", environment))
        programs[-1].status()
        match.status()
        return programs[-1]

    yield start_team
    for program in programs:
        program.end()


def log_of(team: Program) -> list[str]:
    """What the robot has printed."""
    (run,) = (team.folder / "runs").iterdir()
    return (run / "magenta1.log").read_text().splitlines()


def test_a_team_s_robot_has_a_chosen_environment_a_folder_of_its_own_and_limits(start: Start) -> None:
    """It joins with the credentials that the match on this machine has announced."""
    team = start("--brain", "team:Brain", "--open-files", "200", "--pass-environment", "MODEL")
    assert team.status() == 0, (team.out, team.err)
    log = log_of(team)
    assert "secrets []" in log and "model small" in log and "files 200" in log
    (folder,) = (line.split()[1:] for line in log if line.startswith("folder "))
    assert folder[0] == folder[1] and folder[0].endswith("/magenta1")
    assert "read secret" in log  # which isolation prevents
    assert "robots run as your user: they can read your files and signal your processes" in team.err + team.out


def test_a_team_s_robot_that_exceeds_a_limit_is_named_with_the_option_that_raises_it(start: Start) -> None:
    team = start("--brain", "team:Greedy", "--memory", "1.5")
    told = "limit reached: it used more than 1.5 GB of memory; raise [limits] memory, or --memory of touchline team"
    assert told in team.out + team.err


@needs_bubblewrap()
def test_in_bubblewrap_a_team_s_robot_reads_its_team_s_folder_and_nothing_else_of_the_user(start: Start) -> None:
    team = start("--brain", "team:Brain", "--isolate", "bubblewrap")
    assert team.status() == 0, (team.out, team.err)
    log = log_of(team)
    assert "read secret" not in log and log.count("refused secret.txt") == 2
    assert "robots run as your user" not in team.err + team.out


def test_a_limit_out_of_range_is_refused_with_the_name_of_its_option(tmp_path: Path) -> None:
    team = Program(["touchline", "team", "magenta", "--brain", "a:B", "--memory", "0"], tmp_path, "team", {})
    assert team.status() == 2
    assert "--memory" in team.err
