"""CPU time of matches in one process, and of their parts, for `bench_against`: runs in any revision since 8617a4eb."""

import importlib
import json
import sys
import time
from typing import Any

try:
    from touchline.play.play_match import play_match
except ImportError:  # a module, before it became a room
    from touchline.play import play_match
from schemas.config.match_config import load_match
from sim_host.match.simulation import Simulation

TEAMS = {
    "simple": "robot_agent.teams.simple:Simple",
    "nubot": "robot_agent.teams.nubot:NuBot",
    "reference": "robot_agent.teams.reference:Reference",
}
MATCHES = (("simple", "nubot"), ("reference", "reference"))
SEEDS = (1, 2)

spent: dict[str, float] = {}


def timed(part: str, owner: Any, method: str) -> None:
    """Let the calls of a method count for a part."""
    function = getattr(owner, method)
    spent[part] = 0.0

    def call(*given: Any, **named: Any) -> Any:
        began = time.thread_time()
        result = function(*given, **named)
        spent[part] += time.thread_time() - began
        return result

    setattr(owner, method, call)


def main() -> None:
    """Play each pair of teams with each seed, and print the CPU time in s of each part as JSON."""
    seconds = float(sys.argv[1])
    timed("in process: Simulation.step", Simulation, "step")
    for team, name in TEAMS.items():
        module, _, brain = name.partition(":")
        timed(f"in process: brains of {team}", getattr(importlib.import_module(module), brain), "act")
    for cyan, magenta in MATCHES:
        began = time.process_time()
        for seed in SEEDS:
            given = {"seed": seed, "teams.cyan.brain": TEAMS[cyan], "teams.magenta.brain": TEAMS[magenta]}
            play_match(load_match(None, given), until=seconds)
        spent[f"in process: {cyan} - {magenta}"] = time.process_time() - began
    print(json.dumps(spent))


if __name__ == "__main__":
    main()
