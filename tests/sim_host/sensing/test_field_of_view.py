"""Fields of view: a camera that does not see all round finds what is ahead of it, up to the edges of its view."""

import math
from dataclasses import replace

import numpy as np
import pytest

from schemas.config.match_config import load_match
from schemas.config.noise import PERFECT
from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.sections import CameraView
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation
from sim_host.sensing.view import View
from support.scenery import Scenery, roster_of

NARROW = math.radians(100.0)
EDGE = 1e-6


def scenery(views: list[float], robots: list[tuple[float, ...]], ball: tuple[float, ...], **sensing) -> Scenery:
    """Robots with these fields of view; further robots see all round."""
    standard = RobotModel.standard(load_profile("msl"))
    models = [replace(standard, camera=CameraView(view)) for view in views]
    models += [standard] * (len(robots) - len(views))
    return Scenery(robots, ball, roster=replace(roster_of(len(robots), 0), models=tuple(models)), **sensing)


def around(angle: float, distance: float = 3.0) -> tuple[float, float]:
    return distance * math.cos(angle), distance * math.sin(angle)


@pytest.mark.parametrize("heading", [0.0, 1.3, math.pi, -2.9])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("view", [NARROW, math.pi, math.radians(300.0)])
@pytest.mark.parametrize(("beyond", "seen"), [(-EDGE, True), (EDGE, False)])
def test_ball_and_obstacles_are_seen_up_to_the_edges_of_the_view(heading, side, view, beyond, seen):
    angle = heading + side * (view / 2 + beyond)
    one = scenery([view], [(0, 0, heading), around(angle, 5.0)], around(angle)).look()[0]
    assert one.visible == seen
    assert len(one.obstacles) == seen


def test_the_centre_counts_at_any_distance():
    """A robot whose hull reaches into the view is not found."""
    made = scenery([NARROW], [(0, 0), around(NARROW / 2 + 0.02, 0.6)], (1.0, 0.0))
    assert made.look()[0].obstacles == []


def test_a_ball_out_of_view_is_where_it_was_seen_last_with_its_age():
    made = scenery([NARROW], [(0, 0, 0.0)], (3.0, 0.0))
    assert made.look()[0].visible
    made.robots[0] = made.robots[0]._replace(heading=math.pi)
    one = made.look()[0]
    assert not one.visible and one.ball[:2] == [3.0, 0.0] and one.ball_age > 0


def test_robots_have_fields_of_view_of_their_own():
    one, other, third = scenery([NARROW, math.tau], [(0, 0), (0, 2), (0, 4)], (-3.0, 0.0)).look()
    assert not one.visible and one.obstacles == []
    assert other.visible and len(other.obstacles) == 2
    assert third.visible and len(third.obstacles) == 2


def test_cameras_that_see_all_round_find_what_they_found_before_there_was_a_field_of_view():
    """The same noise and the same bodies, also directly behind and at the robot's own place."""
    dice = np.random.default_rng(1)
    robots = [tuple(row) for row in dice.uniform(-5, 5, (6, 3))]
    noise = {"sensing": load_profile("msl").sensing}
    plain, mixed = Scenery(robots, (0.0, 1.0), **noise), scenery([math.tau] * 5 + [NARROW], robots, (0.0, 1.0), **noise)
    for _ in range(40):
        assert plain.look()[:5] == mixed.look()[:5]


def test_what_is_in_view_has_the_noise_that_it_has_without_edges():
    robots = [(0, 0, 0.0), (3, 1), (-3, 1), (4, -1)]
    noise = {"sensing": replace(load_profile("msl").sensing, obstacle_dropout=0.0)}
    plain, narrow = Scenery(robots, (2.0, 0.0), **noise), scenery([NARROW], robots, (2.0, 0.0), **noise)
    for _ in range(40):
        one, other = plain.look()[0], narrow.look()[0]
        assert other.ball == one.ball
        assert other.obstacles == [row for row in one.obstacles if row[0] > 0]


def test_robots_of_a_type_may_see_less(tmp_path):
    path = tmp_path / "ahead.toml"
    path.write_text(
        'extends = "msl"\n[types.ahead.camera]\nfield_of_view = { value = 1.5, unit = "rad", origin = "a webcam" }\n'
    )
    profile = load_profile(str(path))
    assert RobotModel.of_type(profile, "ahead").camera.field_of_view == 1.5
    assert RobotModel.standard(profile).camera.field_of_view == math.tau


def test_the_field_of_view_changes_while_the_match_runs_and_the_world_goes_on():
    """It concerns the sights alone: no checkpoint is made."""
    simulation = Simulation(load_match(None, {"noise.preset": "perfect"}))
    before = Sight.decode(simulation.step({}).sights["cyan2"])
    request = ParametersRequest(operation=ParameterOperation.SET, values={"camera.field_of_view": 0.01})
    assert simulation.handle_parameters(request).accepted
    tick = simulation.step({})
    assert not tick.applied["checkpoint"]
    after = Sight.decode(tick.sights["cyan2"])
    assert len(before.obstacles) == 9 and len(after.obstacles) < 9
    assert validated(Setup, simulation.setup().plain()).camera.field_of_view == 0.01
    simulation.close()


def test_perfect_noise_does_not_turn_the_camera_round():
    """The view is the robot's, as its hull; presets change the noise."""
    one = scenery([NARROW], [(0, 0)], (-3.0, 0.0), sensing=PERFECT).look()[0]
    assert not one.visible


def test_the_edge_of_the_view_belongs_to_it():
    """With half a turn to each side, a thing at a right angle to the kick axis is exactly on the edge."""
    half_plane, places = View(np.array([[0.0]])), np.array([[0.0 + 2.0j, -0.001 + 2.0j, 0.001 - 2.0j]])
    assert half_plane.has(places, np.abs(places), np.array([0.0])).tolist() == [[True, False, True]]
