"""The shipped tasks: their baseline does them, and their recordings verify."""

from pathlib import Path
from statistics import mean

import pytest

from schemas.config.match_config import MatchConfig
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from support.task_moment import task_config
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch
from touchline.verify.resimulate import verify

GAINS = {
    "coverage": (1, 12.0, 0.15),
    "dribble_slalom": (1, 12.0, 5.0),
    "formation": (1, 8.0, 2.0),
    "free_kick": (2, 8.0, 0.15),
    "goalkeeper": (5, None, 0.3),
    "half_field_4v5": (20, None, 0.1),
    "keepaway_3v2": (2, None, 3.0),
    "pass_and_shoot": (3, None, 0.3),
    "pursuit": (1, 18.5, 5.0),
    "push_box": (1, 7.0, 2.0),
    "rendezvous": (1, 9.0, 1.5),
    "two_on_one": (2, None, 0.3),
    "warehouse": (1, 20.0, 4.0),
}
"""Task → number of seeds, s that its episodes are cut to, and by how much its baseline is better on average than robots
that stand."""
LONG = ("half_field_4v5",)
"""Its goals are rare, and its ten robots decide much."""


class Still:
    """Stands."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, dribble=True)


@pytest.mark.slow
@pytest.mark.parametrize("task", [pytest.param(one, marks=[pytest.mark.long] * (one in LONG)) for one in GAINS])
def test_the_baseline_is_much_better_than_robots_that_stand(task: str) -> None:
    seeds, duration, gain = GAINS[task]
    cut = {"duration": duration} if duration else {}
    configs = [task_config(task, seed, **cut) for seed in range(1, seeds + 1)]
    baseline = mean(final_score(InProcessMatch(config, chained=False)) for config in configs)
    still = mean(final_score(InProcessMatch(config, standing(config), chained=False)) for config in configs)
    assert baseline > still + gain


@pytest.mark.slow
@pytest.mark.parametrize("task", [*GAINS, "full_match"])
def test_the_recording_of_an_episode_verifies(task: str, tmp_path: Path) -> None:
    match = InProcessMatch(task_config(task, duration=1.0))
    recording = MatchRecording(tmp_path / "task.mcap", match.simulation.config, match.simulation)
    while not match.simulation.over:
        recording.add(match.step(), match.commands)
    recording.close()
    match.close()
    assert verify(tmp_path / "task.mcap", referee=True).identical


def standing(config: MatchConfig) -> dict[str, Still]:
    """Robots that stand in place of those that do the task."""
    assert config.task is not None
    return {name: Still() for name in config.robots(config.task.side)}


def final_score(match: InProcessMatch) -> float:
    """The score at the end of an episode."""
    while not match.simulation.over:
        match.step()
    match.close()
    value: float = match.simulation.state.value
    return value
