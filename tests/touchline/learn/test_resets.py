"""Learning resets environments for hours: their memory stays."""

import json
import subprocess
import sys

import pytest

EPISODES = 80
PROGRAM = """
import gc, json, sys
from pathlib import Path

from touchline.learn import TaskEnv


def kept():
    gc.collect()
    resident = int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6
    return resident, len(gc.get_objects()), sys.getallocatedblocks()


def play(episodes):
    for seed in range(episodes):
        env.reset(seed)
        env.step({agent: env.action_space(agent).sample() for agent in env.agents})


episodes = int(sys.argv[1])
env = TaskEnv("keepaway_3v2")
play(episodes // 2)
before = kept()
play(episodes)
print(json.dumps([now - then for now, then in zip(kept(), before)]))
env.close()
"""
"""Prints what so many episodes, with a step of each, leave in a process that has played half as many before, and does
nothing else: MB of memory, objects that Python's collector knows, and blocks that Python has allocated."""


@pytest.mark.slow
def test_episodes_leave_no_memory_and_no_objects_behind() -> None:
    command = [sys.executable, "-c", PROGRAM, str(EPISODES)]
    memory, objects, blocks = json.loads(subprocess.run(command, check=True, stdout=-1, text=True).stdout)
    assert memory < 0.1 * EPISODES, "an episode keeps more than 0.1 MB; its engine has 35 MB"
    assert objects < EPISODES, "an episode keeps an object"
    assert blocks < 1.5 * EPISODES, "an episode keeps a block, besides the 60 to 90 that so many leave, or 120"
