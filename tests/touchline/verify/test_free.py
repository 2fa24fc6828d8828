"""A match of the game free: verify judges it again by the score's program in the recording, if told to."""

from pathlib import Path
from typing import Any

import pytest
from pytest import approx

from recordings.reading.recording import open_recording
from schemas.config.roster import Placement
from schemas.errors import TouchlineError
from schemas.messages.scene import SceneOperation, SceneRequest
from support.free_match import SCORE, free_match, record_free_match
from touchline.matches.engine.measurement import measured
from touchline.play.play_match import InProcessMatch
from touchline.team.debugger.live_match import LiveMatch
from touchline.verify.compare_brain import compare_brain
from touchline.verify.resimulate import verify


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording in which the box is pushed, and in which an operator makes checkpoints on the way."""
    folder = tmp_path_factory.mktemp("free")

    def place(match: InProcessMatch) -> None:
        if match.simulation.now.tick in (70, 110):
            place = [Placement(body="two", x=5.0, y=-4.0)]
            match.simulation.handle_scene(SceneRequest(operation=SceneOperation.PLACE, place=place))

    return record_free_match(folder, free_match(folder, SCORE.replace("now.tick >= 60", "now.tick >= 150")), place)


def test_a_recording_is_verified_with_its_score_once_somebody_trusts_its_program(recorded: Path) -> None:
    careful, trusting = verify(recorded), verify(recorded, referee=True)
    assert careful.identical and trusting.identical and trusting.ticks == 151
    assert any("its score is a program in the recording, which --referee runs" in one for one in careful.not_checked)
    assert trusting.referee and not careful.referee


def test_what_is_not_told_to_runs_nothing_of_the_recording(tmp_path: Path, monkeypatch) -> None:
    proof = tmp_path / "ran"
    config = free_match(tmp_path, f"import pathlib\npathlib.Path({str(proof)!r}).touch()\n{SCORE}", duration=0.1)
    path = record_free_match(tmp_path, config)
    proof.unlink()
    verify(path)
    assert compare_brain(open_recording(path), "one", "support.free_match:Pusher").first is None
    (tmp_path / "tally.py").unlink()
    monkeypatch.chdir(tmp_path)
    with pytest.raises(TouchlineError, match=r'task.score is "tally:count"; there is no tally.py in .*; put its file'):
        LiveMatch(open_recording(path), "one", "support.free_match:Pusher")
    assert not proof.exists()
    verify(path, referee=True)
    assert proof.exists()


def test_from_a_checkpoint_on_the_box_moves_as_recorded(recorded: Path) -> None:
    pushed = [world for _, world in open_recording(recorded).decoded("world")]
    assert pushed[109].obstacles["box"].pushed.vx > 0.1  # the checkpoint is made while it moves
    assert verify(recorded, processes=2, referee=True).identical


def test_a_changed_score_is_found(recorded: Path, edited, at_tick) -> None:
    def better(fields: dict[str, Any]) -> dict[str, Any]:
        return fields | {"value": fields["value"] + 1.0}

    path = edited(recorded, "game/state", at_tick(100, better))
    difference = verify(path, referee=True).difference
    assert difference is not None and difference.tick == 100
    assert verify(path).difference is None


def test_a_moved_box_is_found(recorded: Path, edited, at_tick) -> None:
    def nearer(fields: dict[str, Any]) -> dict[str, Any]:
        fields["obstacles"]["box"]["x"] += 0.01
        return fields

    difference = verify(edited(recorded, "world", at_tick(100, nearer))).difference
    assert difference is not None and difference.details[0].of == "box"


def test_an_outcome_of_a_plan_has_the_score(recorded: Path) -> None:
    played = measured(recorded, "id")
    assert played.figures is None and 0.0 < played.value < 2.0
    assert played.playing_time == approx(3.0)
