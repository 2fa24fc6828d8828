"""Matches of several robots, as many on both sides or not: each robot is seen, commanded and moved by itself."""

import json

import pytest

from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive
from sim_host.match.simulation import Simulation

TICKS = 25


@pytest.mark.parametrize(("cyan", "magenta"), [(1, 1), (1, 2), (3, 3), (5, 2), (5, 5)])
def test_each_of_several_robots_sees_all_others_and_obeys_its_own_commands(cyan: int, magenta: int) -> None:
    sizes = {"teams": {"cyan": {"size": cyan}, "magenta": {"size": magenta}}, "noise": {"preset": "perfect"}}
    simulation = Simulation(load_match(None, {"rules": "friendly", "referee": {"automatic": False}, **sizes}))
    names = simulation.roster.names
    assert len(names) == cyan + magenta
    began = simulation.now.world["robots"]
    for tick in range(TICKS):
        sights = {name: json.loads(sight) for name, sight in simulation.now.sights.items()}
        assert sorted(sights) == sorted(names)
        assert tick < 5 or all(len(sight["obstacles"]) <= len(names) - 1 for sight in sights.values())
        turns = {name: 0.1 * (number + 1) for number, name in enumerate(names)}
        simulation.step(
            {name: Command(answers_tick=sights[name]["tick"], drive=Drive(omega=turns[name])) for name in names}
        )
    now = simulation.now.world["robots"]
    assert [now[name]["omega"] for name in names] == pytest.approx([turns[name] for name in names], abs=1e-6)
    assert all(abs(now[name]["x"] - began[name]["x"]) < 1e-3 for name in names)
    simulation.close()
