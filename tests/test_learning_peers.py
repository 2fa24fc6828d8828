"""The peers of `benchmarks/bench_learn_peers.py` in processes of their own."""

import subprocess
import sys
from pathlib import Path

import pytest

PEERS = Path(__file__).parents[1] / "benchmarks" / "learning_peers.py"


@pytest.mark.processes
@pytest.mark.parametrize(
    ("peer", "robots", "reason"),
    [("rc-robosim", 4, "No module named 'robosim'"), ("dm_control", 1, "its teams have equal sizes")],
)
def test_a_peer_that_cannot_play_says_why_in_one_line(peer: str, robots: int, reason: str) -> None:
    command = [sys.executable, "-S", str(PEERS), peer, str(robots)]  # without the packages that are installed
    done = subprocess.run(command, input="\n\n", capture_output=True, text=True, check=True)
    assert done.stdout == f"learning-peer: no {reason}\n"
