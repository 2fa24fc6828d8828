"""Sights as they are sent: percepts in the message of `schemas.messages.sight`."""

import math
from collections.abc import Iterator
from itertools import pairwise

import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.noise import PRESETS
from schemas.messages.command import Command, Drive
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight
from sim_host.match.simulation import Simulation


def simulate(**overrides: object) -> Simulation:
    return Simulation(load_match(None, {key.replace("__", "."): value for key, value in overrides.items()}))


def sight(simulation: Simulation, robot: str) -> Sight:
    return Sight.decode(simulation.now.sights[robot])


def drive(simulation: Simulation, ticks: int) -> Iterator[None]:
    for _ in range(ticks):
        tick = simulation.now.tick
        simulation.step(
            {
                name: Command(answers_tick=tick, drive=Drive(vx=place - 5.0, omega=1.0))
                for place, name in enumerate(simulation.roster.names)
            }
        )
        yield


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("profile", ["msl", "paper"])
def test_every_sight_of_every_preset_is_a_valid_message_with_the_age_of_its_content(preset: str, profile: str) -> None:
    one = simulate(noise__preset=preset, profile=profile)
    for _ in drive(one, 40):
        for name in one.roster.names:
            seen = sight(one, name)
            assert 0.0 <= seen.obstacles_age < 0.07
            assert seen.ball is None or seen.ball.age >= 0.0
            away = [(o.x - seen.self.x) ** 2 + (o.y - seen.self.y) ** 2 for o in seen.obstacles]
            assert all(b - a > -1.0 for a, b in pairwise(away)), "nearest first, but for own noise"
    one.close()


def test_with_perfect_perception_a_sight_is_the_truth() -> None:
    one = simulate(noise__preset="perfect")
    for _ in drive(one, 30):
        world = one.now.world
        for name in ("cyan2", "magenta4"):
            sign, robot, seen = (1 if name == "cyan2" else -1), world["robots"][name], sight(one, name)
            assert (seen.self.x, seen.self.y) == approx((sign * robot["x"], sign * robot["y"]), abs=6e-5)
            assert seen.ball is not None and seen.ball.visible and seen.ball.age == 0.0
            assert (seen.ball.x, seen.ball.y) == approx(
                (sign * world["ball"]["x"], sign * world["ball"]["y"]), abs=6e-5
            )
            others = {other: at for other, at in world["robots"].items() if other != name}
            assert len(seen.obstacles) == len(others)
            for at in others.values():
                place = sign * at["x"], sign * at["y"]
                assert min(math.dist(place, (o.x, o.y)) for o in seen.obstacles) < 1e-4
    one.close()


def test_a_radio_message_beyond_the_budget_is_refused_in_the_outcome_and_not_sent() -> None:
    one = simulate(radio__budget=100.0)
    tick = one.step({"cyan2": Command(answers_tick=0, radio=Radio(intention="much too long for that"))})
    assert sight(one, "cyan2").outcome.refused == ["radio: the team's budget of 0.0001 Mbit/s is used up"]
    assert tick.beliefs == [] and tick.refused == {"cyan2": 1}
    one.close()


def test_what_robots_perceive_changes_nothing_in_the_world() -> None:
    """Equal inputs give equal worlds under every preset."""
    chains = []
    for preset in PRESETS:
        one = simulate(noise__preset=preset)
        for _ in drive(one, 40):
            pass
        chains.append(one.now.applied["chain"])
        one.close()
    assert len(set(chains)) == 1
