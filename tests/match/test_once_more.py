"""A recorded match once more, by the commands themselves: ghosts, and brains that are shown what robots saw."""

import json

import pytest

from recordings.reading.recording import open_recording
from schemas.topics import APPLIED

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = """
seed = 7
duration = 3

[teams.cyan]
size = 2
brain = "robot_agent.teams.simple:Simple"

[teams.magenta]
size = 2
brain = "robot_agent.teams.nubot:NuBot"

[patience]
answer = 60
"""


@pytest.fixture(scope="module")
def played(start, folder):
    """A match with the sights of all robots in its recording."""
    (folder / "match.toml").write_text(MATCH)
    return recorded(start, folder, "first", "--sights")


def recorded(start, folder, name, *words):
    """A match of real processes, and its recording."""
    words = ("--record", f"{name}.mcap", *words, "--listen", "tcp/127.0.0.1:0", "--json")
    program = start("touchline", "match", "match.toml", *words, folder=folder, name=name)
    assert program.status() == 0, program.err
    return open_recording(folder / f"{name}.mcap", whole=True)


def chains(recording):
    return [applied.chain for _, applied in recording.decoded(APPLIED.key)]


def test_a_side_that_its_ghosts_play_makes_the_recorded_match_again(played, start, folder):
    """Equal seed, equal live brains: what the live side sees is what it saw, and the world is the same bit for bit."""
    again = recorded(start, folder, "again", "--ghost", "magenta=first.mcap")
    assert chains(again) == chains(played)
    assert len(chains(again)) > 150
    assert again.manifest.setup.teams["magenta"].name.endswith(", recorded")


@pytest.mark.long
def test_a_ghost_goes_on_with_what_it_did_when_the_live_side_does_something_else(played, start, folder):
    again = recorded(start, folder, "other", "--ghost", "magenta=first.mcap", "--seed", "8")
    first, second = ([applied.inputs for _, applied in recording.decoded(APPLIED.key)] for recording in (played, again))
    assert chains(again) != chains(played)
    both = list(zip(first, second, strict=False))[1:100]
    assert all(one["magenta1"].drive == other["magenta1"].drive for one, other in both)
    assert any(one["cyan1"].drive != other["cyan1"].drive for one, other in both)


def against(start, folder, name, agent):
    program = start("touchline", "replay", "first.mcap", "--agent", agent, "--json", folder=folder, name=name)
    return program.status(), json.loads(program.out)


def test_the_brain_that_played_repeats_its_commands(played, start, folder):
    status, said = against(start, folder, "same", "cyan2=robot_agent.teams.simple:Simple")
    assert (status, said["sights"], said["different"], said["first"]) == (0, "recorded", 0, None)
    assert said["compared"] > 150


def test_the_first_differing_command_of_another_brain_is_reported(played, start, folder):
    status, said = against(start, folder, "nubot", "cyan2=robot_agent.teams.nubot:NuBot")
    assert status == 1
    assert 0 < said["different"] <= said["compared"]
    assert said["first"]["recorded"] != said["first"]["answered"]
