"""Pictures of recordings, drawn by `docs/generate/draw_match.py`."""

import math

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.patches import Circle, Rectangle

from draw_match import draw
from draw_readings import draw_readings
from schemas.config.obstacle import Shape
from schemas.config.sensors.compass import Compass, CompassReading
from schemas.config.sensors.contact import Bumper, ContactReading
from schemas.config.sensors.range import RangeFinder, RangeReading
from schemas.config.task import GameName, Zone
from schemas.errors import TouchlineError
from schemas.messages.setup import TaskSetup
from schemas.messages.world import ObstacleTruth, World
from schemas.side import Side
from schemas.topics import WORLD
from touchline.drawing.bodies import COLOURS, draw_bodies
from touchline.drawing.picture import drawn


def world_at(recorded, second: float) -> World:
    return next(world for _, world in recorded.decoded(WORLD.key, start=second))


@pytest.mark.parametrize("second", [None, 0.5])
def test_a_match_is_drawn_with_the_robots_of_both_sides(recorded, tmp_path, second):
    draw(recorded.path, second).savefig(tmp_path / "match.png")
    pixels = np.round(imread(tmp_path / "match.png")[..., :3] * 255)
    for side in Side:
        wanted = [int(COLOURS[side][i : i + 2], 16) for i in (1, 3, 5)]
        assert np.mean(np.all(np.abs(pixels - wanted) <= 1, axis=-1)) > 0.001


@pytest.mark.parametrize("second", [-1.0, 100.0])
def test_a_time_outside_the_recording_is_named_with_the_times_it_has(recorded, second):
    with pytest.raises(TouchlineError, match=r"no world at .* from 0 to 3\.98 s"):
        draw(recorded.path, second)


@pytest.mark.parametrize("game", GameName)
def test_the_zones_of_a_task_are_drawn_with_their_names(recorded, game):
    zones = [Zone(name="dock", place=[2.0, 1.0], radius=1.51), Zone(name="yard", place=[-3.0, 0.0], size=[2.0, 4.01])]
    setup = recorded.setup.replace(game=game, task=TaskSetup(score="a:b", zones=zones))
    _, axes, _ = drawn(setup, [world_at(recorded, 1.0)], 4.0)
    places = {text.get_text(): text.get_position() for text in axes.texts}
    assert (places["dock"], places["yard"]) == ((2.0, 1.0), (-3.0, 0.0))
    (dock,) = (patch for patch in axes.patches if isinstance(patch, Circle) and patch.radius == 1.51)
    (yard,) = (patch for patch in axes.patches if isinstance(patch, Rectangle) and patch.get_height() == 4.01)
    assert (dock.center, yard.get_width(), yard.get_center()) == ((2.0, 1.0), 2.0, pytest.approx((-3.0, 0.0)))


def test_an_obstacle_is_drawn_where_it_truly_is(recorded):
    crate = ObstacleTruth(x=3.0, y=-2.0, heading=0.5, radius=1.12, height=0.5, shape=Shape.BOX, size_x=2.0, size_y=1.0)
    axes = Figure().subplots()
    draw_bodies(axes, recorded.setup, [world_at(recorded, 1.0).replace(obstacles={"crate": crate})], 0.3)
    (box,) = (patch for patch in axes.patches if isinstance(patch, Rectangle))
    assert (box.get_width(), box.get_height(), box.angle) == (2.0, 1.0, pytest.approx(math.degrees(0.5)))
    assert box.get_center() == pytest.approx((3.0, -2.0))


def test_the_readings_of_sensors_are_drawn_where_they_were_taken(recorded):
    """Beams end at what they met, an arc is at the touched side, and a needle points along the measured heading."""
    front = RangeFinder(beams=2, span=1.0, max_distance=5.0, x=0.1)
    sensors = {"standard": {"front": front, "north": Compass(), "bumper": Bumper(sectors=4)}}
    world = world_at(recorded, 1.0)
    readings = {
        "front": RangeReading(age=0.0, angle_min=-0.25, angle_increment=0.5, distances=[None, 2.0]),
        "north": CompassReading(age=0.0, heading=math.pi / 2),
        "bumper": ContactReading(age=0.0, touched=[False, True, False, False]),
    }
    own = world.robots["cyan2"].replace(x=1.0, y=2.0, heading=math.pi)
    told = world.replace(robots={**world.robots, "cyan2": own}, sensors={"cyan2": readings})
    axes = Figure().subplots()
    draw_readings(axes, recorded.setup.replace(sensors=sensors), [told, world], 0.3)
    beams, needle, arcs = (drawn.get_segments() for drawn in axes.collections)
    assert beams[0].tolist() == [
        pytest.approx((0.9, 2.0)),
        pytest.approx((0.9 - 2.0 * math.cos(0.25), 2.0 - 2.0 * math.sin(0.25))),
    ]
    assert needle[0][1][0] == pytest.approx(1.0) and needle[0][1][1] > 2.5
    assert len(arcs) == 1 and arcs[0].mean(axis=0)[1] < 2.0, "the left of a robot that looks to −x is at −y"
