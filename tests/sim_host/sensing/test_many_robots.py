"""Pictures with more robots than a match has: what is seen does not depend on how its computation is cut down."""

import math
import random
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest

from schemas.config.obstacle import Shape
from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.sections import CameraView
from sim_host.sensing import hulls, pair_draws
from sim_host.sensing.random_streams import RandomStreams, StreamId, name_words
from sim_host.snapshot import ObstacleState
from support.scenery import Scenery, Seen, roster_of

MSL = load_profile("msl").sensing
STANDARD = RobotModel.standard(load_profile("msl"))
FRAMED = replace(STANDARD, body=replace(STANDARD.body, frame_width=0.6, frame_depth=0.08))
LOW = replace(STANDARD, body=replace(STANDARD.body, height=0.4), camera=CameraView(field_of_view=2.0))
OBSTACLES = (
    ObstacleState("wall", 1.0, 2.0, 0.3, 1.03, 0.8, Shape.BOX, 0.5, 2.0),
    ObstacleState("step", -3.0, 2.0, 0.0, 0.5, 0.3, Shape.CYLINDER, 1.0, 1.0),
    ObstacleState("mast", 4.0, -2.0, 1.0, 0.2, 2.0, Shape.CYLINDER, 0.4, 0.4),
)


@contextmanager
def limits(least_hulls: int, least_pairs: int) -> Iterator[None]:
    """From how many hulls and pairs on only those that matter are computed."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(hulls, "MANY_HULLS", least_hulls)
        patch.setattr(pair_draws, "MANY_PAIRS", least_pairs)
        yield


def crowd(count: int, spread: float, **sensing: object) -> Scenery:
    """Robots of three kinds anywhere within `spread` m of the centre, some inside each other; and obstacles."""
    chance = random.Random(count)
    places = [[chance.uniform(-spread, spread) for _ in "xy"] + [chance.uniform(-4, 4)] for _ in range(count)]
    models = tuple((STANDARD, FRAMED, LOW)[place % 3] for place in range(count))
    roster = replace(roster_of(count // 2, count - count // 2), models=models)
    made = Scenery(places, (0.3, 0.2, 0.11, 1.0, 2.0), count // 2, roster=roster, **{"sensing": MSL, **sensing})
    made.obstacles = OBSTACLES
    return made


def pictures(made: Scenery, count: int) -> list[list[Seen]]:
    """What is seen while the ball flies up and around, and robots are moved."""
    chance, seen = random.Random(count), []
    for number in range(count):
        x, y = 5.0 * math.cos(number), 5.0 * math.sin(number)
        made.ball = made.ball._replace(x=x, y=y, z=0.11 + 0.2 * (number % 5))
        made.move(number % len(made.robots), chance.uniform(-6, 6), chance.uniform(-6, 6))
        seen.append(made.look())
    return seen


@pytest.mark.parametrize("sensing", [{}, {"noise_rate": 0.3}, {"occlusion": "nothing", "obstacle_range": 1000.0}])
@pytest.mark.parametrize(("count", "spread"), [(1, 1.0), (12, 2.0), (50, 7.0), (50, 1.5)])
def test_robots_see_the_same_whether_all_hulls_and_pairs_are_computed_or_those_that_matter(count, spread, sensing):
    with limits(1000, 1_000_000):
        every = pictures(crowd(count, spread, **sensing), 40)
    with limits(0, 0):
        few = pictures(crowd(count, spread, **sensing), 40)
    assert few == every
    assert any(one.obstacles for seen in every for one in seen)


@pytest.mark.parametrize("bearing", [math.pi, -math.pi + 1e-9, 3.1, -3.1, 0.0, math.pi / 2])
def test_a_hull_hides_at_every_bearing(bearing):
    """The bearings that shadows are sorted by jump there from π to −π."""
    ahead = np.exp(1j * bearing)
    row = [(2.0 * ahead.real, 2.0 * ahead.imag), (4.0 * ahead.real, 4.0 * ahead.imag)]
    far = [(100.0 + 3.0 * place, 100.0) for place in range(50)]
    with limits(0, 0):
        seen = Scenery([(0.0, 0.0), *row, *far], (3.0 * ahead.real, 3.0 * ahead.imag), occlusion="hulls").look()
    assert seen[0].ball is None
    assert len(seen[0].obstacles) == 1 + len(far)


def test_robots_out_of_sight_change_nothing_however_many_they_are():
    """Four robots see and are detected alike, alone and with sixty others beyond the range of their cameras."""
    near, far = [(0.0, 0.0), (2.0, 0.5), (4.0, 0.0), (-3.0, 1.0)], [(60.0, 2.0 * place) for place in range(60)]
    alone = Scenery(near, (1.0, 1.0), 4, sensing=MSL)
    among = Scenery([*near, *far], (1.0, 1.0), 4, sensing=MSL)
    for _ in range(60):
        assert among.look()[:4] == alone.look()


def test_the_draws_of_single_pairs_are_those_of_all_pairs():
    streams, robots, things = RandomStreams(3), ("cyan1", "cyan2", "magenta1"), ("ball", "cyan1", "cyan2")
    every = streams.pairwise_uniforms(StreamId.SEEN, robots, things, [7, 2**32 + 8])
    rows, columns = np.array([2, 0, 1, 2]), np.array([0, 2, 1, 2])
    names = name_words(robots)[rows], name_words(things)[columns]
    for place, tick in enumerate((7, 2**32 + 8)):
        assert (streams.uniforms_of_pairs(StreamId.SEEN, *names, tick) == every[place, rows, columns]).all()
    assert streams.uniforms_of_pairs(StreamId.SEEN, names[0][:0], names[1][:0], 7).shape == (0, 4)
