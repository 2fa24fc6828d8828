"""The peers of `benchmarks/bench_learn_peers.py` in processes of their own."""

import subprocess
import sys
from pathlib import Path

PEERS = Path(__file__).parents[1] / "benchmarks" / "learning_peers.py"


def answers(peer: str, robots: int) -> list[str]:
    """What a peer prints that is to do two rounds."""
    command = [sys.executable, str(PEERS), peer, str(robots)]
    done = subprocess.run(command, input="\n\n", capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def test_a_peer_that_is_not_installed_says_so_in_one_line() -> None:
    [line] = answers("rc-robosim", 4)
    assert line == "learning-peer: no No module named 'robosim'"


def test_a_peer_says_in_one_line_that_its_game_has_other_teams() -> None:
    assert answers("dm_control", 1) == ["learning-peer: no its teams have equal sizes"]
