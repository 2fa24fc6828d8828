"""A real recorded match once more: sides played by their ghosts, and brains shown what robots saw."""

from pathlib import Path

import pytest

from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from schemas.messages.command import Drive
from schemas.topics import APPLIED
from touchline.play.ghost import Ghost, check_ghosts, inputs_of, teams_of
from touchline.play.play_match import InProcessMatch
from touchline.verify.compare_brain import compare_brain

SIMPLE, NUBOT = "robot_agent.teams.simple:Simple", "robot_agent.teams.nubot:NuBot"
UNTIL = 5.0
SIDES = {"teams.cyan": {"size": 2, "brain": SIMPLE}, "teams.magenta": {"size": 2, "brain": NUBOT}}


@pytest.fixture(scope="module")
def played(match_recorder, tmp_path_factory) -> Recording:
    """Five seconds of two against two."""
    path = tmp_path_factory.mktemp("played") / "match.mcap"
    match_recorder(path, load_match(None, {"seed": 5, "duration": 20.0, **SIDES}), UNTIL)
    return open_recording(path, whole=True)


def chains(recording: Recording, ghosts: list[str], seed: int = 5) -> tuple[list[str], list[str]]:
    """The hash chains of the recorded match and of one where these robots are ghosts."""
    table = InProcessMatch(
        load_match(None, {"seed": seed, "duration": 20.0, **SIDES}),
        {name: Ghost(name, inputs_of(recording)) for name in ghosts},
    )
    recorded = [applied.chain for _, applied in recording.decoded(APPLIED.key)]
    again = [table.simulation.now.applied["chain"]]
    again += [table.step().applied["chain"] for _ in recorded[1:]]
    table.simulation.close()
    return recorded, again


def test_a_match_of_ghosts_alone_is_the_recorded_match(played):
    recorded, again = chains(played, ["cyan1", "cyan2", "magenta1", "magenta2"], seed=99)
    assert again == recorded


def test_one_side_of_ghosts_does_what_it_did_whatever_the_other_does(played):
    """Live robots see other noise from another seed: the world diverges, and ghosts keep their recorded inputs."""
    recorded, again = chains(played, ["magenta1", "magenta2"], seed=99)
    assert again[0] == recorded[0] and again[-1] != recorded[-1]
    ghost = Ghost("magenta1", inputs_of(played))
    told = {applied.tick: applied.inputs for _, applied in played.decoded(APPLIED.key)}
    table = InProcessMatch(load_match(None, {"seed": 99, "duration": 20.0, **SIDES}), {"magenta1": ghost})
    for _ in range(100):
        tick = table.step()
        assert tick.applied["inputs"]["magenta1"].drive == told[tick.tick]["magenta1"].drive
    table.simulation.close()


def test_a_ghost_rests_where_nothing_is_recorded(played):
    table = InProcessMatch(
        load_match(None, {"seed": 5, **SIDES}), {"cyan1": Ghost("cyan1", list(inputs_of(played))[:20])}
    )
    drives = [table.step().applied["inputs"]["cyan1"].drive for _ in range(30)]
    assert any(drive != Drive() for drive in drives[:19])
    assert all(drive == Drive() for drive in drives[19:])
    table.simulation.close()


def test_a_ghost_side_takes_the_robots_that_were_recorded(played):
    teams = teams_of([f"magenta={played.path}"])
    assert teams["magenta"]["robots"] == ["magenta1", "magenta2"]
    config = load_match(None, {"teams.magenta": teams["magenta"]})
    check_ghosts(config, [f"magenta={played.path}"])
    assert config.teams.magenta.stdio[-1] == str(Path(played.path).resolve())


@pytest.mark.parametrize(
    ("ghost", "word"), [("magenta", "write it as"), ("blue=a.mcap", "write it as"), ("cyan=none.mcap", "No such file")]
)
def test_an_invalid_ghost_is_reported(ghost, word):
    with pytest.raises(TouchlineError, match=word):
        teams_of([ghost])


def test_a_side_has_one_ghost(played):
    with pytest.raises(TouchlineError, match="another one plays cyan"):
        teams_of([f"cyan={played.path}"] * 2)


def test_a_recording_with_other_ticks_is_no_ghost_here(played):
    with pytest.raises(TouchlineError, match="its ticks last"):
        check_ghosts(load_match(None, {"profile": "paper"}), [f"cyan={played.path}"])


def test_a_robot_that_did_not_play_is_reported(played):
    with pytest.raises(TouchlineError, match='robot is "cyan9"'):
        compare_brain(played, "cyan9", SIMPLE)
