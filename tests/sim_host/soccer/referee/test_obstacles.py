"""An obstacle that stands where the ball is to be placed: the ball goes to the nearest free spot, as in a league."""

import math

import pytest

from schemas.config.obstacle import Shape
from schemas.side import Side
from schemas.soccer.game import EventKind, OfficiatingMode, Phase
from sim_host.snapshot import ObstacleState
from sim_host.soccer.referee.placement import clear_ground
from sim_host.soccer.referee.placement.clear_ground import clearance


def pillar(x: float, y: float, radius: float = 0.3) -> ObstacleState:
    return ObstacleState("pillar", x, y, 0.0, radius, 1.0, Shape.CYLINDER, 2 * radius, 2 * radius)


def block(x: float, y: float, heading: float, length: float, width: float) -> ObstacleState:
    return ObstacleState("block", x, y, heading, math.hypot(length, width) / 2, 1.0, Shape.BOX, length, width)


def room(rig) -> float:
    """m between an obstacle's hull and the ball's centre that let a robot stand between them."""
    return rig.radius + 2.0 * max(model.body.reach for model in rig.roster.models)


def test_at_a_kick_off_the_ball_is_placed_on_the_halfway_line_beside_the_obstacle(rig):
    rig.obstacles = (pillar(0.0, 0.0),)
    rig.tick((3.0, 3.0))
    x, y = rig.state.spot
    assert x == 0.0
    assert 0.3 + room(rig) <= abs(y) < 0.3 + room(rig) + 0.05
    assert rig.ball[:2] == (x, y)
    assert f"{abs(y):.2f} m from its spot, where an obstacle stands" in rig.events[-1].text


def test_a_throw_in_is_moved_along_its_line_and_the_game_goes_on_from_there(rig):
    line = rig.pitch.touch_line - rig.book.restarts.touch_line_inset
    rig.obstacles = (pillar(1.2, line),)
    rig.crossing((1.0, rig.pitch.touch_line - 0.1), (1.0, rig.pitch.touch_line + 0.3), ["cyan2"])
    rig.until(lambda state: state.phase is Phase.THROW_IN)
    assert rig.state.spot[1] == pytest.approx(line)
    assert rig.state.spot[0] < 1.2 - 0.3 - rig.radius, "the nearer side of the pillar"
    rig.until(lambda state: state.running)
    rig.tick(rig.state.spot, ["magenta2"], kicked="magenta2")
    rig.tick((rig.state.spot[0], line - 1.0))
    assert rig.state.phase is Phase.PLAY


def test_a_penalty_keeps_its_distance_from_the_goal(rig):
    mark = rig.pitch.goal_line - rig.pitch.penalty_mark
    rig.obstacles = (pillar(mark, 0.0),)
    rig.playing()
    rig.ask("penalty", Side.CYAN)
    rig.until(lambda state: state.phase is Phase.PENALTY)
    assert rig.state.spot[0] == pytest.approx(mark)
    assert 0.3 + rig.radius < abs(rig.state.spot[1])


def test_a_free_kick_beside_a_long_block_is_moved_past_its_near_side_and_not_over_a_line(rig):
    rig.obstacles = (block(0.0, 2.0, math.pi / 4, 6.0, 0.4),)
    rig.playing()
    rig.ask("drop_ball", place=(0.1, 2.0))
    rig.until(lambda state: state.phase is Phase.DROP_BALL)
    x, y = rig.state.spot
    off_the_block = abs(x - (y - 2.0)) / math.sqrt(2.0)
    assert off_the_block >= 0.2 + room(rig) - 1e-6
    assert math.dist((x, y), (0.1, 2.0)) < 0.2 + room(rig) + 0.1


def test_a_corner_that_is_built_over_stays_inside_the_lines(rig):
    rig.obstacles = (pillar(rig.pitch.goal_line, rig.pitch.touch_line, 1.0),)
    rig.playing()
    rig.ask("corner", Side.CYAN, place=(rig.pitch.goal_line, rig.pitch.touch_line))
    rig.until(lambda state: state.phase is Phase.CORNER)
    x, y = rig.state.spot
    assert abs(x) <= rig.pitch.goal_line and abs(y) <= rig.pitch.touch_line
    assert math.dist((x, y), (rig.pitch.goal_line, rig.pitch.touch_line)) >= 1.0 + room(rig)


def test_a_ball_beside_the_outer_side_of_a_wide_block_is_moved_outward_and_not_around_it(rig):
    """The free ground is 0.3 m away from the centre of the field; toward the centre it is metres away."""
    rig.obstacles = (block(0.0, 0.0, 0.0, 4.6, 10.0),)
    rig.playing((4.0, 0.0))
    rig.ask("drop_ball", place=(2.3, 0.0))
    rig.until(lambda state: state.phase is Phase.DROP_BALL)
    x, y = rig.state.spot
    assert x >= 2.3 + room(rig) - 1e-6 and math.dist((x, y), (2.3, 0.0)) < room(rig) + 0.06


def test_an_obstacle_that_leaves_the_spot_free_moves_nothing(rig):
    rig.obstacles = (pillar(0.5, 0.0),)
    rig.tick((3.0, 3.0))
    assert rig.state.spot == (0.0, 0.0)
    assert "obstacle" not in rig.events[-1].text


def test_an_obstacle_that_is_put_on_the_spot_after_the_signal_has_the_restart_signalled_beside_it(rig):
    rig.tick((3.0, 3.0))
    assert rig.state.spot == (0.0, 0.0)
    rig.obstacles = (pillar(0.0, 0.0),)
    ruling = rig.tick((0.0, 0.6))
    assert rig.state.spot != (0.0, 0.0)
    assert [event.kind for event in ruling.events] == [EventKind.RESTART]
    assert [(placed.x, placed.y) for placed in ruling.placements] == [rig.state.spot]
    spot = rig.state.spot
    rig.until(lambda state: state.running)
    assert rig.state.spot == spot
    assert [event.kind for event in rig.events].count(EventKind.RESTART) == 2


def test_a_pitch_without_free_ground_leaves_the_ball_where_the_rules_have_it(new_rig):
    rig = new_rig(dt=0.2)
    rig.obstacles = (pillar(0.0, 0.0, 30.0),)
    rig.tick((3.0, 3.0))
    assert rig.state.spot == (0.0, 0.0)
    rig.until(lambda state: state.running)


def test_a_pitch_without_free_ground_is_searched_once_and_not_in_each_tick(new_rig, monkeypatch):
    measured = []

    def counted(obstacles, spot):
        measured.append(spot)
        return clearance(obstacles, spot)

    monkeypatch.setattr(clear_ground, "clearance", counted)
    rig = new_rig()
    rig.obstacles = (block(0.0, 0.0, 0.0, 39.0, 39.0),)
    rig.tick((0.0, 0.0))
    first = len(measured)
    rig.tick((0.0, 0.0))
    assert len(measured) - first < 10 < first


def test_placing_the_ball_on_an_occupied_place_is_refused(new_rig):
    rig = new_rig(mode=OfficiatingMode.MANUAL)
    rig.ask("start")
    rig.ask("start")
    rig.playing()
    rig.obstacles = (pillar(2.0, 1.0),)
    rig.ask("stop")
    assert "an obstacle stands at" in rig.ask("place_ball", place=(2.1, 1.0)).replies[0].reason
    assert rig.ask("place_ball", place=(2.6, 1.0)).replies[0].accepted


def test_no_robot_with_a_wrong_position_is_placed_in_an_obstacle(new_rig):
    """A wall on one side of the ball: robots that are moved go to the other side."""
    rig = new_rig()
    walls = tuple(pillar(x / 2, y, 0.25) for x in range(-12, 13) for y in (2.6, 3.1, 3.6))
    rig.tick((3.0, 3.0))
    rig.obstacles = walls
    assert rig.book.restarts.moves_offenders
    rig.robots["magenta3"] = (0.8, 1.0)
    rig.until(lambda state: state.running)
    x, y = rig.robots["magenta3"]
    assert all(math.dist((x, y), (wall.x, wall.y)) > wall.radius + rig.hull for wall in walls)
