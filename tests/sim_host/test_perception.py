"""What robots perceive: the team frame, noise of the right size, and never a trace of it on the truth."""

import math
from dataclasses import fields

import numpy as np
import pytest
from pytest import approx

from schemas.match_config import load_match
from schemas.noise import sensing_of
from schemas.profile import Sensing, load_profile
from schemas.side import Side
from sim_host.sensing.perception import Percept, Perception
from sim_host.sensing.streams import Streams
from sim_host.snapshot import BallState, RobotState, Roster, Snapshot

ROSTER = Roster.of(load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 2}), load_profile("msl"))
ROBOTS = (
    RobotState(-3.0, 1.0, 0.4, 0.5, 1.0, -0.5, 0.2, False),
    RobotState(2.0, -4.0, 0.4, -3.0, 0.0, 0.0, 0.0, False),
    RobotState(5.0, 0.5, 0.4, math.pi, -2.0, 0.1, -0.3, False),
    RobotState(8.0, 3.0, 0.4, 1.0, 0.0, 0.0, 0.0, False),
)
BALL = BallState(1.0, 2.0, 0.5, 3.0, -1.0, 0.7)
PERFECT = sensing_of("perfect", load_profile("msl").sensing)


def snapshot(tick: int = 0) -> Snapshot:
    return Snapshot(tick, tick * 0.02, ROSTER, ROBOTS, BALL, None, ())


class Named:
    """A percept by names instead of places."""

    def __init__(self, percept: Percept) -> None:
        self.own = dict(zip(("x", "y", "heading", "vx", "vy", "omega"), percept, strict=False))
        self.ball = dict(zip(("x", "y", "z", "vx", "vy"), percept[6:], strict=False))
        self.obstacles = list(zip(percept[11::2], percept[12::2], strict=True))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Named) and vars(self) == vars(other)


def perceive(sensing: Sensing, tick: int = 0, seed: int = 1, cyan_attacks: int = 1) -> list[Named]:
    return [Named(one) for one in Perception(sensing, ROSTER, Streams(seed)).at(snapshot(tick), cyan_attacks)]


def test_perfect_perception_is_the_truth_in_the_team_frame() -> None:
    cyan, _, magenta, _ = perceive(PERFECT)
    assert cyan.own == {"x": -3.0, "y": 1.0, "heading": 0.5, "vx": 1.0, "vy": -0.5, "omega": 0.2}
    assert magenta.own == approx({"x": -5.0, "y": -0.5, "heading": 0.0, "vx": 2.0, "vy": -0.1, "omega": -0.3})
    assert cyan.ball == {"x": 1.0, "y": 2.0, "z": 0.5, "vx": 3.0, "vy": -1.0}
    assert (magenta.ball["x"], magenta.ball["y"], magenta.ball["vx"]) == (-1.0, -2.0, -3.0)


def test_after_the_change_of_sides_each_team_still_attacks_plus_x() -> None:
    first = perceive(PERFECT, cyan_attacks=1)
    second = perceive(PERFECT, cyan_attacks=-1)
    assert second[0].own["x"] == -first[0].own["x"]
    assert second[2].own["x"] == -first[2].own["x"]
    assert math.remainder(second[0].own["heading"] - first[0].own["heading"] - math.pi, 2 * math.pi) == approx(
        0, abs=2e-4
    )


def test_obstacles_are_all_the_others_nearest_first_and_unlabelled() -> None:
    assert perceive(PERFECT)[0].obstacles == [(2.0, -4.0), (5.0, 0.5), (8.0, 3.0)]
    assert perceive(PERFECT)[1].obstacles == [(5.0, 0.5), (-3.0, 1.0), (8.0, 3.0)]


@pytest.mark.parametrize(
    ("sigma", "read"),
    [
        ("own_position", lambda p: p.own["x"]),
        ("own_heading", lambda p: p.own["heading"]),
        ("own_velocity", lambda p: p.own["vy"]),
        ("own_turn_rate", lambda p: p.own["omega"]),
        ("ball_position", lambda p: p.ball["y"]),
        ("ball_velocity", lambda p: p.ball["vx"]),
        ("obstacle_position", lambda p: p.obstacles[2][0]),
    ],
)
def test_each_noise_has_the_mean_and_sigma_it_is_given(sigma: str, read: object) -> None:
    """4,000 ticks: the mean within 4 standard errors, sigma within 5 %; no other number is touched."""
    sensing = Sensing(**{field.name: 0.05 if field.name == sigma else 0.0 for field in fields(Sensing)})
    perception = Perception(sensing, ROSTER, Streams(9))
    percepts = [Named(perception.at(snapshot(tick), 1)[0]) for tick in range(4000)]
    values = np.array([read(percept) for percept in percepts]) - read(perceive(PERFECT)[0])  # type: ignore[operator]
    assert values.mean() == approx(0, abs=4 * 0.05 / math.sqrt(4000))
    assert values.std() == approx(0.05, rel=0.05)
    assert np.corrcoef(values[1:], values[:-1])[0, 1] == approx(0, abs=0.065)


def test_the_papers_noise_is_a_preset() -> None:
    """Section 2.3: sigma 0.0194 on positions, velocities and yaw rate, none on the heading."""
    paper = sensing_of("paper", PERFECT)
    assert (paper.ball_position, paper.own_velocity, paper.own_turn_rate, paper.own_heading) == (0.0194,) * 3 + (0.0,)


def test_two_robots_do_not_share_their_noise() -> None:
    one, other = perceive(load_profile("msl").sensing)[:2]
    assert one.ball["x"] != other.ball["x"]


def test_equal_seeds_perceive_equally_and_others_do_not() -> None:
    sensing = load_profile("msl").sensing
    assert perceive(sensing, tick=77) == perceive(sensing, tick=77)
    assert perceive(sensing, tick=77) != perceive(sensing, tick=77, seed=2)
    assert perceive(sensing, tick=77) != perceive(sensing, tick=78)


def test_both_sides_of_a_mirrored_world_perceive_the_same() -> None:
    turned = tuple(
        RobotState(-r.x, -r.y, r.z, math.remainder(r.heading + math.pi, 2 * math.pi), -r.vx, -r.vy, r.omega, False)
        for r in ROBOTS[2:] + ROBOTS[:2]
    )
    mirrored = Snapshot(
        0, 0.0, ROSTER, turned, BallState(-BALL.x, -BALL.y, BALL.z, -BALL.vx, -BALL.vy, BALL.vz), None, ()
    )
    here = perceive(PERFECT)
    there = [Named(one) for one in Perception(PERFECT, ROSTER, Streams(1)).at(mirrored, 1)]
    for mine, theirs in zip(here[:2], there[2:], strict=True):
        assert theirs.own == approx(mine.own, abs=2e-4)
        assert theirs.ball == approx(mine.ball, abs=2e-4)
    assert Side.CYAN.opponent is Side.MAGENTA
