"""Learning resets environments for hours: their memory stays."""

import gc
import sys
from pathlib import Path

import pytest

from touchline.learn import TaskEnv

EPISODES = 80


def resident_mb() -> float:
    """The memory of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


def kept() -> tuple[float, int, int]:
    """Memory in MB, objects that Python's collector knows, and blocks that Python has allocated."""
    gc.collect()
    return resident_mb(), len(gc.get_objects()), sys.getallocatedblocks()


def play(env: TaskEnv, episodes: int) -> None:
    """Begin as many episodes, with a step of each."""
    for seed in range(episodes):
        env.reset(seed)
        env.step({agent: env.action_space(agent).sample() for agent in env.agents})


@pytest.mark.slow
def test_episodes_leave_no_memory_and_no_objects_behind() -> None:
    env = TaskEnv("keepaway_3v2")
    play(env, EPISODES // 2)
    memory, objects, blocks = kept()
    play(env, EPISODES)
    now = kept()
    env.close()
    assert now[0] - memory < 10.0, "an episode keeps more than 0.1 MB; its engine has 35 MB"
    assert now[1] - objects < EPISODES, "an episode keeps an object"
    assert now[2] - blocks < EPISODES, "an episode keeps a block"
