"""A match of soccer with a task: verify judges and scores it again."""

from pathlib import Path

import pytest

from schemas.config.roster import Placement
from schemas.messages.command import Command, Drive
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.sight import Sight
from support.task_match import task_match
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch
from touchline.verify.resimulate import verify


@pytest.mark.slow
def test_a_recording_is_verified_with_its_score(tmp_path: Path, edited, at_tick) -> None:
    match = InProcessMatch(task_match(tmp_path), {"cyan1": Chaser(), "magenta1": Chaser()})
    recording = MatchRecording(tmp_path / "task.mcap", match.simulation.config, match.simulation)
    while not match.simulation.over:
        if match.simulation.now.tick == 60:
            place = [Placement(body="magenta1", x=5.0, y=-4.0)]
            match.simulation.handle_scene(SceneRequest(operation=SceneOperation.PLACE, place=place))
        recording.add(match.step(), match.commands)
    recording.close()
    match.close()
    assert verify(tmp_path / "task.mcap", referee=True).identical
    assert verify(tmp_path / "task.mcap", referee=True, processes=2).identical
    better = edited(
        tmp_path / "task.mcap", "game/state", at_tick(100, lambda fields: fields | {"value": fields["value"] + 1.0})
    )
    difference = verify(better, referee=True).difference
    assert difference is not None and difference.tick == 100


class Chaser:
    """Drives ahead in a curve."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0, omega=0.3), dribble=True)
