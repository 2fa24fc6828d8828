"""Learning resets environments for hours: their memory stays."""

import gc
from pathlib import Path

import pytest

from touchline.learn import TaskEnv


def resident_mb() -> float:
    """The memory of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


@pytest.mark.slow
def test_resets_leave_no_memory_behind() -> None:
    env = TaskEnv("keepaway_3v2")
    for seed in range(40):
        env.reset(seed)
    gc.collect()
    before = resident_mb()
    for seed in range(80):
        env.reset(seed)
    gc.collect()
    env.close()
    assert resident_mb() - before < 10.0, "an episode keeps more than 0.1 MB; its engine has 35 MB"
