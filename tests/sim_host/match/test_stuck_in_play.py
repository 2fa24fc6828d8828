"""The stuck flag in play: ten robots that all go for the ball, as the README's first brain does, clinch for seconds."""

import math
from collections import deque

import pytest

from schemas.config.match_config import load_match
from touchline.play import InProcessMatch

BRAIN = "examples.first_brain:FirstBrain"
SECONDS = 55.0
WINDOW = 25
"""Ticks, half a second."""


@pytest.fixture(scope="module")
def history() -> list[list[tuple[float, float, bool, bool]]]:
    """Tick → robot → demanded speed, speed, whether it touches another robot, and the flag."""
    match = InProcessMatch(load_match(None, {"seed": 1, "teams.cyan.brain": BRAIN, "teams.magenta.brain": BRAIN}))
    simulation, told = match.simulation, []
    top = simulation.profile.drive.max_speed
    while simulation.now.time < SECONDS:
        tick = match.step()
        inputs, snapshot = tick.applied["inputs"], simulation.world.snapshot()
        touching = {place for pair in snapshot.contacts for place in pair}
        told.append(
            [
                (
                    min(top, math.hypot(inputs[name].drive.vx, inputs[name].drive.vy)),
                    math.hypot(state.vx, state.vy),
                    place in touching,
                    tick.world["robots"][name]["stuck"],
                )
                for place, (name, state) in enumerate(zip(simulation.roster.names, snapshot.robots, strict=True))
            ]
        )
    simulation.close()
    return told


def windows(history: list[list[tuple[float, float, bool, bool]]]) -> list[tuple[float, float, bool, bool]]:
    """For each robot and tick: demand and speed averaged over the last half second, any contact in it, the flag."""
    found = []
    for place in range(len(history[0])):
        last: deque[tuple[float, float, bool, bool]] = deque(maxlen=WINDOW)
        for tick in history:
            last.append(tick[place])
            demands, speeds, contacts, flags = zip(*last, strict=True)
            found.append((sum(demands) / len(last), sum(speeds) / len(last), any(contacts), flags[-1]))
    return found


def test_robots_that_clinch_in_play_are_stuck_most_of_that_time(history) -> None:
    """They touch, demand more than 0.6 m/s and move at less than 0.15 m/s, over half a second."""
    flags = [flag for demand, speed, contact, flag in windows(history) if contact and demand > 0.6 and speed < 0.15]
    assert len(flags) > 200
    assert sum(flags) / len(flags) > 0.7, "the rest is the time until it is noticed"


def test_no_robot_in_play_is_stuck_while_it_gets_on(history) -> None:
    """One that has moved at half of its demand over half a second; not one tick in 200."""
    moving = [flag for demand, speed, _, flag in windows(history) if speed > max(0.3, 0.5 * demand)]
    assert len(moving) > 800
    assert sum(moving) < len(moving) / 200
