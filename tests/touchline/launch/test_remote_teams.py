"""Remote teams: the launcher reports who is there and who is missing, and how the other side joins."""

import ipaddress
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig, load_match
from schemas.errors import TouchlineError
from schemas.messages.health import Health, RobotHealth
from schemas.side import Side
from touchline.launch import own_address
from touchline.launch.join_command import join_lines
from touchline.launch.remote_teams import RemoteTeams

OPEN = "tcp/0.0.0.0:7447"


def config(**magenta: object) -> MatchConfig:
    overrides = {"teams.magenta.remote": True, "teams.magenta.size": 2, "patience.remote": 60.0}
    return load_match(None, overrides | {f"teams.magenta.{key}": value for key, value in magenta.items()})


def health(*present: str, tick: int = 0) -> Health:
    robots = {name: RobotHealth(alive=name in present) for name in ("cyan1", "magenta1", "magenta2")}
    return Health(tick=tick, time=tick * 0.02, pace="realtime", real_time_factor=1.0, robots=robots)


def test_a_team_is_remote_by_one_word_or_by_a_table(tmp_path):
    file = tmp_path / "cup.toml"
    file.write_text('[teams]\nmagenta = "remote"\n')
    assert load_match(file) == load_match(None, {"teams.magenta.remote": True})
    assert load_match(file).remote_sides == (Side.MAGENTA,)
    assert load_match(file).team(Side.MAGENTA).brain is None


def test_a_team_that_an_option_makes_remote_keeps_the_name_and_the_robots_of_the_file(tmp_path):
    file = tmp_path / "cup.toml"
    file.write_text('[teams.magenta]\nname = "Guests"\nsize = 3\nbrain = "mine:Brain"\n')
    team = load_match(file, {"teams.magenta.remote": True}).team(Side.MAGENTA)
    assert (team.name, team.size, team.brain, team.remote) == ("Guests", 3, None, True)


def test_a_remote_team_has_no_program_here():
    with pytest.raises(TouchlineError, match=r"teams\.magenta: the team is remote, .* leave brain out"):
        config(brain="mine:Brain")


def test_the_robots_that_join_and_leave_are_reported_with_their_number():
    teams = RemoteTeams(config())
    assert teams.update(health("cyan1"), 0.0) == []
    assert teams.update(health("cyan1", "magenta2"), 1.0) == ["magenta2 joined: 1 of 2 robots of magenta are there"]
    assert teams.update(health("magenta2"), 2.0) == []
    assert teams.update(health("magenta1"), 3.0) == [
        "magenta1 joined: 2 of 2 robots of magenta are there",
        "magenta2 left: 1 of 2 robots of magenta are there",
    ]


@pytest.mark.parametrize(
    ("present", "line"),
    [
        ([], "waiting for magenta: no robot there; missing: magenta1, magenta2"),
        (["magenta2"], "waiting for magenta: magenta2 there; missing: magenta1"),
        (["magenta1", "magenta2"], ""),
    ],
)
def test_until_the_match_begins_the_status_names_who_is_there_and_who_is_missing(present, line):
    teams = RemoteTeams(config())
    teams.update(health(*present), 0.0)
    assert teams.waiting(health(*present)) == line
    assert teams.waiting(health(*present, tick=1)) == ""


def test_a_team_of_which_no_robot_comes_in_time_is_absent():
    teams = RemoteTeams(config())
    for now in (100.0, 159.9):
        teams.update(health("cyan1"), now)
        assert teams.absent is None
    teams.update(health("cyan1"), 160.0)
    assert teams.absent is Side.MAGENTA
    assert "no robot of magenta joined within 60 s" in teams.absence(Side.MAGENTA)


@pytest.mark.parametrize("early", [health("magenta1"), health("cyan1", tick=1)], ids=["one robot", "started by hand"])
def test_a_match_that_has_a_robot_of_the_team_or_was_started_in_time_is_played(early):
    teams = RemoteTeams(config())
    teams.update(early, 0.0)
    teams.update(early.replace(tick=2), 61.0)
    teams.update(health(tick=3), 100.0)
    assert teams.absent is None


def test_a_match_without_remote_teams_waits_for_none():
    teams = RemoteTeams(load_match(None))
    assert (teams.update(health(), 0.0), teams.waiting(health()), teams.absent) == ([], "", None)
    assert join_lines(load_match(None), OPEN, "tcp/127.0.0.1:7447", None) == []


def test_the_other_side_s_command_names_an_address_of_this_machine_and_the_port_that_was_free(monkeypatch):
    monkeypatch.setattr(
        "touchline.launch.join_command.endpoint_for_others", lambda at: at.replace("0.0.0.0", "10.1.2.3")
    )
    (line,) = join_lines(config(), "tcp/0.0.0.0:0", "tcp/127.0.0.1:40123", None)
    assert line == "magenta joins with: touchline team magenta --connect tcp/10.1.2.3:40123 --brain MODULE:CLASS"


def test_the_other_side_s_command_names_its_file_of_credentials_alone():
    folder = Path("runs/one/credentials")
    command, file = join_lines(config(), "tcp/10.1.2.3:7447", "tcp/10.1.2.3:7447", folder)
    assert "--connect tcp/10.1.2.3:7447 --credentials magenta.json --brain" in command
    assert file.endswith("no other file: runs/one/credentials/magenta.json")


@pytest.mark.parametrize("listen", [None, "tcp/127.0.0.1:7447"])
def test_a_host_on_loopback_says_that_no_other_machine_can_join(listen):
    command, note = join_lines(config(), listen, "tcp/127.0.0.1:7447", None)
    assert "--connect tcp/127.0.0.1:7447" in command
    assert "this machine only" in note and "--listen tcp/[::]:7447" in note


@pytest.mark.parametrize("listen", ["tcp/[::]:7447", OPEN])
def test_a_listener_on_every_address_is_reached_at_one_that_is_not_loopback(listen, monkeypatch):
    monkeypatch.setattr(own_address, "own_address", lambda: "10.1.2.3")
    assert own_address.endpoint_for_others(listen) == "tcp/10.1.2.3:7447"


def test_a_listener_on_one_address_is_reached_there():
    for endpoint in ("tcp/lab3:7447", "tcp/[fd00::7]:7447", "tcp/10.1.2.3:7447"):
        assert own_address.endpoint_for_others(endpoint) == endpoint


def test_this_machine_has_an_address_or_a_name():
    found = own_address.own_address()
    try:
        assert not ipaddress.ip_address(found).is_unspecified
    except ValueError:
        assert found  # a machine without a network has its name
