"""The same match again: on the bus, without one, and with another seed."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.world import World
from schemas.topics import APPLIED, RECORD_BATCH, WORLD, WORLD_BALL, WORLD_ROBOT
from support.brisk import BRISK
from support.free_match import free_match
from touchline.play.play_match import play_match

SHIPPED = {
    "duration": 2,
    "rules": str(BRISK),
    "teams": {
        "cyan": {"brain": "robot_agent.teams.simple:Simple", "size": 3},
        "magenta": {"brain": "robot_agent.teams.nubot:NuBot", "size": 2},
    },
}


@dataclass
class Watched:
    """All that was published of a whole match."""

    worlds: list[World]
    chains: list[str]


@pytest.fixture
def watch_match(rig_of):
    def watch(seed: int) -> Watched:
        rig = rig_of(seed=seed, **SHIPPED)
        worlds, applied = rig.listen(WORLD), rig.listen(APPLIED)
        rig.join_all()
        rig.host.run()
        return Watched(worlds.all(), [message.chain for message in applied.all()])

    return watch


@pytest.mark.slow
def test_the_same_seed_gives_the_same_match_tick_for_tick_on_the_bus_and_without_one(watch_match):
    first, again = watch_match(7), watch_match(7)
    assert [world.tick for world in first.worlds] == list(range(len(first.worlds)))
    assert len(first.worlds) > 100
    assert again.worlds == first.worlds
    assert again.chains == first.chains
    alone = []
    played = play_match(
        MatchConfig.model_validate({"seed": 7, **SHIPPED}), watch=lambda tick: alone.append(tick.applied["chain"])
    )
    assert alone == first.chains[1:]
    assert (played.chain, played.ticks) == (first.chains[-1], len(first.worlds) - 1)


def test_single_bodies_are_published_as_in_the_world_of_the_same_tick(rig_of):
    """A key for each body, one message for all, one number of the tick for both."""
    rig = rig_of(duration=2, rules=str(BRISK))
    worlds, robots, balls = rig.listen(WORLD), rig.listen(WORLD_ROBOT), rig.listen(WORLD_BALL)
    rig.join_all()
    rig.host.run()
    world_at = {world.tick: world for world in worlds.all()}
    frames, ball_frames = robots.all(), balls.all()
    assert frames and ball_frames
    assert all(frame.robot in world_at[frame.tick].robots.values() for frame in frames)
    assert all(frame.ball == world_at[frame.tick].ball for frame in ball_frames)


def test_a_score_that_fails_ends_the_match_with_all_ticks_before_it_sent_to_recorders(rig_of, tmp_path: Path) -> None:
    faulty = "def count(now):\n    return 1 / (now.tick - 11)\n"
    rig = rig_of(**free_match(tmp_path, faulty).model_dump())
    batches = rig.listen(RECORD_BATCH)
    rig.join_all()
    with pytest.raises(TouchlineError, match=r"ZeroDivisionError: .* \(tally.py, line 2\) at tick 11"):
        rig.host.run()
    assert batches.all()[-1].tick == 10
