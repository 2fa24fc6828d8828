"""Several matches that start in the same second on one machine, and agents that come to a match that is not theirs."""

import json
import re
import shlex
import shutil
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from runtime.bus.announcement import announcement_in
from schemas.config.match_config import load_match
from schemas.topics import APPLIED
from support.brisk import BRISK
from support.process_story import wait_for
from touchline.play.play_match import play_match

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = f'rules = "{BRISK}"\n[teams.cyan]\nsize = 2\n[teams.magenta]\nsize = 2\n[patience]\nanswer = 60\n'
"""A machine that is busy with other things must not make a robot miss a tick."""
SEEDS = (1, 2)
ROOT = Path(__file__).parents[2]


def chain_of(program, folder):
    """The hash chain over all states of a match."""
    assert program.status() == 0, program.err
    result = json.loads(program.out)
    assert result["losses"] == {}
    applied = [recorded.message() for recorded in open_recording(folder / result["recording"]).messages(APPLIED.key)]
    return applied[-1].chain


def test_matches_that_start_in_the_same_second_are_the_matches_of_their_seeds_alone(start, folder):
    (folder / "small.toml").write_text(MATCH)

    def begin(seed, name):
        arguments = ("touchline", "match", "small.toml", "--duration", "2", "--seed", str(seed), "--json")
        return start(*arguments, folder=folder, name=name)

    together = [begin(seed, f"together{number}") for number, seed in enumerate(SEEDS)]
    alone = [play_match(load_match(folder / "small.toml", {"seed": seed, "duration": 2.0})).chain for seed in SEEDS]
    assert alone[0] != alone[1]
    assert [chain_of(program, folder) for program in together] == alone


def test_a_match_with_tls_is_played_and_leaves_no_passwords(start, tmp_path):
    (tmp_path / "small.toml").write_text(MATCH)
    program = start("touchline", "match", "small.toml", "--duration", "1", "--tls", "--json", folder=tmp_path)
    assert program.status() == 0, program.err
    assert json.loads(program.out)["recording"]
    (run,) = (tmp_path / "runs").iterdir()
    assert 'match "friendly" on tls/127.0.0.1:' in (run / "host.log").read_text()
    assert not (run / "credentials").exists()
    assert not [
        file for file in run.iterdir() if b'"password"' in file.read_bytes() or b"PRIVATE KEY" in file.read_bytes()
    ]


@pytest.fixture(scope="module")
def running(start, folder, tmp_path_factory):
    """A match without end of one against one, its folder, and the environment in which it is announced."""
    environment = {
        name: str(tmp_path_factory.mktemp("user"))  # clients look in both, and find no other match of this user
        for name in ("XDG_RUNTIME_DIR", "XDG_STATE_HOME")
    }
    (folder / "long.toml").write_text(
        'name = "cup"\npace = "realtime"\n[teams.cyan]\nsize = 1\n[teams.magenta]\nsize = 1\n'
    )
    arguments = ("touchline", "match", "long.toml", "--duration", "80000", "--no-record")
    program = start(*arguments, folder=folder, name="long", **environment)
    program.process("magenta1")
    return program, environment


def command(start, folder, name, *arguments, **environment):
    """A finished command of `touchline`."""
    program = start("touchline", *arguments, folder=folder, name=name, **environment)
    program.status()
    return program


def test_a_client_finds_the_running_match_whatever_its_port_and_name(start, folder, running):
    _, environment = running
    asked = command(start, folder, "asked", "coach", "state", "--json", **environment)
    assert asked.status() == 0, asked.err
    assert json.loads(asked.out)["tick"] >= 0


def test_an_agent_with_the_credentials_of_the_other_side_is_refused(start, folder, running):
    program, environment = running
    (credentials,) = program.folder.glob("runs/*/credentials/magenta.json")
    robot = ("--robot", "cyan1", "--brain", "robot_agent.teams.nubot:NuBot", "--credentials", str(credentials))
    refused = command(start, folder, "other_side", "agent", *robot, **environment)
    assert refused.status() == 2
    reason = "cyan1 is a robot of cyan, and the agent plays for magenta"
    assert refused.err == f"touchline: cyan1: refused by the host: {reason}\n"
    event = "that claimed cyan1 was refused: cyan1 is a robot of Simple, and the agent plays for NuBot"
    wait_for(lambda: event in program.out, event)


def typed(page, beginning):
    """The words of the first command of a page that begins so, after `touchline`."""
    text = (ROOT / page).read_text("utf-8")
    return shlex.split(re.findall(rf"^touchline ({beginning} .*)$", text, re.MULTILINE)[0], comments=True)


def test_the_team_of_the_docs_plays_as_typed_and_a_second_agent_is_refused(start, folder):
    endpoint = folder / "docs.json"
    (folder / "cup.toml").write_text('name = "cup"\n' + MATCH)
    assert command(start, folder, "docs_credentials", *typed("docs/networking.md", "credentials new")).status() == 0
    shutil.copy(folder / "credentials" / "magenta.json", folder)
    host = start(
        *("touchline", "host", "cup.toml", "--announcement", str(endpoint), "--listen", "tcp/127.0.0.1:0"),
        *("--credentials", "credentials/host.json"),
        folder=folder,
        name="docs_host",
    )
    announcement = wait_for(lambda: announcement_in(endpoint), f"announcement; {host.err}")

    def here(words):
        return [re.sub(r"^tcp/\S+", announcement.endpoint, word) for word in words]

    team = start("touchline", *here(typed("docs/networking.md", "team magenta")), folder=folder, name="docs_team")
    state = ("coach", "state", "--connect", announcement.endpoint, "--credentials", "credentials/viewer.json")

    def both_are_there():
        return "2 of 4 robots are connected" in command(start, folder, "docs_state", *state).err

    wait_for(both_are_there, f"robots of the team; {team.out} {team.err}")
    second = command(start, folder, "docs_second", *here(typed("docs/networking.md", "agent")))
    assert second.status() == 2
    assert second.err.startswith("touchline: magenta1: refused by the host: magenta1 has an agent already: process ")
    assert team.popen.poll() is None
