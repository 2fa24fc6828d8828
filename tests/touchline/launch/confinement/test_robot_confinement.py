"""What a robot's process is confined to, without starting one."""

import os
from pathlib import Path

import pytest

from robot_agent.process.stdio.command_line import command_line
from schemas.config.confinement import Isolation
from schemas.config.match_config import MatchConfig, load_match
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.launch.confinement.bubblewrap import bubblewrap
from touchline.launch.confinement.robot_confinement import (
    Confinement,
    isolation_note,
    team_confinements,
    team_isolation_note,
)
from touchline.launch.confinement.robot_environment import robot_environment, server_environment
from touchline.launch.confinement.team_code import TeamCode, team_code


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two teams in packages of their own, two as files beside each other; the current directory."""
    monkeypatch.chdir(tmp_path)
    for package in ("lions", "tigers"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "brain.py").touch()
    for module in ("one_team.py", "other_team.py"):
        (tmp_path / module).touch()
    return tmp_path


def match_of(cyan: str, magenta: str, **more: object) -> MatchConfig:
    return load_match(None, {"teams.cyan.brain": cyan, "teams.magenta.brain": magenta, **more})


def note_of(config: MatchConfig) -> str:
    return isolation_note(config, None)


def test_only_listed_variables_of_the_launcher_reach_a_robot() -> None:
    launcher = {
        "PATH": "/bin",
        "LC_ALL": "C",
        "PYTHONPATH": "",
        "GITHUB_TOKEN": "x",
        "TOUCHLINE_TOKEN": "y",
        "HOME": "/me",
    }
    environment = robot_environment(launcher, {"TOUCHLINE_ROBOT": "cyan1"}, Path("/run/cyan1"), ["MISSING"])
    kept = {"PATH": "/bin", "LC_ALL": "C", "PYTHONPATH": "", "TOUCHLINE_ROBOT": "cyan1", "HOME": "/run/cyan1"}
    assert {name: environment[name] for name in kept} == kept
    assert environment.keys() - kept.keys() <= {"PYTHONUSERBASE"}


def test_a_module_path_names_the_same_folders_from_the_working_folder_of_a_robot(here: Path) -> None:
    environment = robot_environment({"PYTHONPATH": f"lions{os.pathsep}/opt/x"}, {}, Path("/run/cyan1"))
    assert environment["PYTHONPATH"] == f"{here / 'lions'}{os.pathsep}/opt/x"


def test_what_all_forked_robots_can_read_names_none_of_them() -> None:
    environment = server_environment({"PYTHONHASHSEED": "0", "TOUCHLINE_LAUNCH_TOKEN": "x", "TOUCHLINE_ROBOT": "cyan1"})
    assert environment["PYTHONHASHSEED"] == "0"
    assert not [name for name in environment if name.startswith("TOUCHLINE_") or name == "HOME"]


def test_files_on_the_command_line_of_a_program_are_found_from_its_working_folder(here: Path) -> None:
    (here / "robot").touch()
    command = command_line(["./robot", "--fast", "one_team.py", "lions/brain.py", "3"])
    assert command == (f"{here}/robot", "--fast", f"{here}/one_team.py", f"{here}/lions/brain.py", "3")
    assert command_line(["python3"]) == ("python3",)
    program = ["env", "python3", "-c", "pass; " * 100]
    assert command_line(program) == tuple(program)
    config = load_match(None, {"teams.cyan.command": program, "teams.magenta.brain": "simple"})
    assert team_code(config, Side.CYAN, None).own == ()


def test_a_team_s_limits_replace_those_of_the_match() -> None:
    config = load_match(None, {"limits.memory": 2.0, "limits.processes": 99, "teams.magenta.limits.memory": 8.0})
    cyan, magenta = (config.limits_of(side) for side in Side)
    assert (cyan.memory, cyan.processes, magenta.memory, magenta.processes) == (2.0, 99, 8.0, 99)


def test_the_limits_of_a_process_are_in_units_of_the_kernel() -> None:
    limits = load_match(None, {"limits.cpu_time": 60.0, "limits.file_size": 0.5}).limits
    own = Confinement(limits, Path("/run/cyan1"), tasks=700).own()
    assert own == {
        "folder": "/run/cyan1",
        "limits": {
            "RLIMIT_CPU": (60, 65),
            "RLIMIT_DATA": (4_000_000_000, 4_000_000_000),
            "RLIMIT_NOFILE": (1024, 1024),
            "RLIMIT_NPROC": (700, 700),
            "RLIMIT_FSIZE": (500_000, 500_000),
            "RLIMIT_CORE": (0, 0),
        },
    }


def test_a_working_folder_is_its_robot_s_alone_and_goes_if_nothing_is_left_in_it(tmp_path: Path) -> None:
    confinement = Confinement(load_match(None).limits, tmp_path / "run" / "cyan1", tasks=700)
    confinement.make_folder()
    assert confinement.folder.stat().st_mode & 0o777 == 0o700
    confinement.remove_empty_folder()
    assert not confinement.folder.exists()
    confinement.make_folder()
    (confinement.folder / "notes").touch()
    confinement.remove_empty_folder()
    assert (confinement.folder / "notes").exists()


def test_for_teams_from_different_folders_one_line_names_what_does_not_separate_them(here: Path) -> None:
    assert note_of(match_of("lions.brain:A", "tigers.brain:B")) == (
        "robots run as your user: both teams can read your files and each other's, and signal your processes; "
        "--isolate bubblewrap prevents it"
    )


@pytest.mark.parametrize(
    ("cyan", "magenta"),
    [
        ("robot_agent.teams.simple:Simple", "robot_agent.teams.nubot:NuBot"),
        ("one_team:A", "robot_agent.teams.nubot:NuBot"),
        ("one_team:A", "other_team:B"),
        ("lions.brain:A", "lions.brain:A"),
    ],
)
def test_a_match_against_a_team_that_ships_or_lies_beside_it_gets_no_line(here: Path, cyan: str, magenta: str) -> None:
    assert note_of(match_of(cyan, magenta)) == ""


def test_the_code_of_a_team_that_plays_a_policy_is_its_file_and_the_brain_that_it_corrects(here: Path) -> None:
    file = here / "lions" / "kick.npz"
    file.touch()
    for corrects, folder, own in (
        ({}, file.parent, (file,)),
        ({"teams.cyan.parameters.corrects": "simple"}, file.parent, (file,)),
        ({"teams.cyan.parameters.corrects": "one_team:A"}, here, (file, here / "one_team.py")),
    ):
        config = match_of("policy:lions/kick.npz", "simple", **corrects)
        assert team_code(config, Side.CYAN, None) == TeamCode(folder, own)


def test_what_is_visible_in_bubblewrap_leaves_out_what_is_hidden_below_it(here: Path) -> None:
    words = bubblewrap(here / "runs" / "cyan1", [here], [here / "tigers", here / "runs"])
    mounted = [words[number + 1] for number, word in enumerate(words) if word == "--ro-bind"]
    assert mounted == [str(here / name) for name in ("lions", "one_team.py", "other_team.py")]
    assert words[words.index("--bind") + 1] == str(here / "runs" / "cyan1")


def test_a_file_that_is_named_is_visible_in_bubblewrap_among_hidden_ones(here: Path) -> None:
    """A ghost's recording lies among the hidden runs."""
    recording = here / "runs" / "earlier" / "match.mcap"
    recording.parent.mkdir(parents=True)
    recording.touch()
    words = bubblewrap(here / "runs" / "cyan1", [recording, recording.parent], [here / "runs"])
    assert [words[number + 1] for number, word in enumerate(words) if word == "--ro-bind"] == [str(recording)]


def test_a_missing_bubblewrap_is_named_with_the_command_that_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(TouchlineError, match="needs the program bwrap; install it with: apt-get install bubblewrap"):
        team_confinements(load_match(None, {"isolate": "bubblewrap"}), None, Path("runs"))


@pytest.mark.skipif(os.geteuid() != 0, reason="only root's robots run as another user")
def test_root_is_told_where_its_isolated_robots_cannot_have_their_folders(here: Path) -> None:
    config = load_match(None, {"isolate": "bubblewrap"})
    (here / "closed").mkdir(mode=0o700)
    with pytest.raises(TouchlineError, match=r"run as nobody, who may not enter .*closed; start the match in another"):
        team_confinements(config, None, here / "closed" / "runs")


def test_a_side_that_another_machine_launches_gets_no_confinement_here() -> None:
    config = load_match(None, {"teams.magenta.remote": True})
    assert list(team_confinements(config, None, Path("runs"))) == [Side.CYAN]


def test_a_team_of_its_own_gets_a_line_on_what_does_not_separate_it_from_the_machine(here: Path) -> None:
    line = (
        "robots run as your user: they can read your files and signal your processes; --isolate bubblewrap prevents it"
    )
    own, shipped = match_of("lions.brain:A", "robot_agent.teams.nubot:NuBot"), Side.MAGENTA
    assert team_isolation_note(own, Side.CYAN, None) == line
    assert team_isolation_note(own, shipped, None) == ""
    isolated = own.model_copy(update={"isolate": Isolation.BUBBLEWRAP})
    assert team_isolation_note(isolated, Side.CYAN, None) == ""
