"""The shipped tasks without a ball: their baseline does them, and their recordings verify."""

from pathlib import Path

import pytest

from schemas.messages.command import Command
from schemas.messages.sight import Sight
from support.task_moment import task_config
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch
from touchline.verify.resimulate import verify

GAINS = {
    "coverage": (12.0, 0.15),
    "formation": (8.0, 2.0),
    "pursuit": (20.0, 5.0),
    "push_box": (10.0, 2.0),
    "rendezvous": (10.0, 1.5),
    "warehouse": (20.0, 4.0),
}
"""Task → s that its episodes are cut to, and by how much its baseline is better then than robots that stand."""


class Still:
    """Stands."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)


@pytest.mark.slow
@pytest.mark.parametrize("task", GAINS)
def test_the_baseline_is_much_better_than_robots_that_stand(task: str) -> None:
    duration, gain = GAINS[task]
    config = task_config(task, duration=duration)
    still = InProcessMatch(config, {name: Still() for name in config.robots(config.task.side)})
    assert final_score(InProcessMatch(config)) > final_score(still) + gain


@pytest.mark.slow
@pytest.mark.parametrize("task", GAINS)
def test_the_recording_of_an_episode_verifies(task: str, tmp_path: Path) -> None:
    match = InProcessMatch(task_config(task, duration=1.0))
    recording = MatchRecording(tmp_path / "task.mcap", match.simulation.config, match.simulation)
    while not match.simulation.over:
        recording.add(match.step(), match.commands)
    recording.close()
    match.close()
    assert verify(tmp_path / "task.mcap", referee=True).identical


def final_score(match: InProcessMatch) -> float:
    """The score at the end of an episode."""
    while not match.simulation.over:
        match.step()
    match.close()
    value: float = match.simulation.state.value
    return value
