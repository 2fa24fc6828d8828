"""A recorded match once more, by the commands themselves: a side that its ghosts play, teams in one process each."""

import pytest

from recordings.reading.recording import open_recording
from schemas.topics import APPLIED
from support.brisk import BRISK

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = f"""
seed = 7
rules = "{BRISK}"
duration = 2

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
    (folder / "match.toml").write_text(MATCH)
    return recorded(start, folder, "first")


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
    assert len(chains(again)) > 100
    assert again.manifest.setup.teams["magenta"].name.endswith(", recorded")


def test_teams_with_one_process_each_play_the_same_match(played, start, folder):
    in_one = MATCH.replace("size = 2", 'size = 2\nprocess = "team"')
    (folder / "match.toml").write_text(in_one)
    together = recorded(start, folder, "together")
    assert chains(together) == chains(played)
    assert {"cyan", "magenta"} <= {path.stem for path in folder.glob("runs/*/*.log")}
