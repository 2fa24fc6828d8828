"""An obstacle that stands where the ball is to be placed: the ball goes to the nearest free spot, as in a league."""

import math

import pytest

from schemas.game import EventKind, Mode, Phase
from schemas.obstacle import Shape
from schemas.side import Side
from sim_host.snapshot import ObstacleState


def pillar(x: float, y: float, radius: float = 0.3) -> ObstacleState:
    return ObstacleState("pillar", x, y, 0.0, radius, 1.0, Shape.CYLINDER, 2 * radius, 2 * radius)


def block(x: float, y: float, heading: float, length: float, width: float) -> ObstacleState:
    return ObstacleState("block", x, y, heading, math.hypot(length, width) / 2, 1.0, Shape.BOX, length, width)


def room(bench) -> float:
    """m between an obstacle's hull and the ball's centre that let a robot stand between them."""
    return bench.radius + 2.0 * max(model.body.reach for model in bench.roster.models)


def test_at_a_kick_off_the_ball_is_placed_on_the_halfway_line_beside_the_obstacle(bench):
    bench.obstacles = (pillar(0.0, 0.0),)
    bench.tick((3.0, 3.0))
    x, y = bench.state.spot
    assert x == 0.0
    assert 0.3 + room(bench) <= abs(y) < 0.3 + room(bench) + 0.05
    assert bench.ball[:2] == (x, y)
    assert f"{abs(y):.2f} m from its spot, where an obstacle stands" in bench.events[-1].text


def test_a_throw_in_is_moved_along_its_line_and_the_game_goes_on_from_there(bench):
    line = bench.pitch.touch_line - bench.book.restarts.touch_line_inset
    bench.obstacles = (pillar(1.2, line),)
    bench.crossing((1.0, bench.pitch.touch_line - 0.1), (1.0, bench.pitch.touch_line + 0.3), ["cyan2"])
    bench.until(lambda state: state.phase is Phase.THROW_IN)
    assert bench.state.spot[1] == pytest.approx(line)
    assert bench.state.spot[0] < 1.2 - 0.3 - bench.radius, "the nearer side of the pillar"
    bench.until(lambda state: state.running)
    bench.tick(bench.state.spot, ["magenta2"], kicked="magenta2")
    bench.tick((bench.state.spot[0], line - 1.0))
    assert bench.state.phase is Phase.PLAY


def test_a_penalty_keeps_its_distance_from_the_goal(bench):
    mark = bench.pitch.goal_line - bench.pitch.penalty_mark
    bench.obstacles = (pillar(mark, 0.0),)
    bench.playing()
    bench.ask("penalty", Side.CYAN)
    bench.until(lambda state: state.phase is Phase.PENALTY)
    assert bench.state.spot[0] == pytest.approx(mark)
    assert 0.3 + bench.radius < abs(bench.state.spot[1])


def test_a_free_kick_beside_a_long_block_is_moved_past_its_near_side_and_not_over_a_line(bench):
    bench.obstacles = (block(0.0, 2.0, math.pi / 4, 6.0, 0.4),)
    bench.playing()
    bench.ask("drop_ball", place=(0.1, 2.0))
    bench.until(lambda state: state.phase is Phase.DROP_BALL)
    x, y = bench.state.spot
    off_the_block = abs(x - (y - 2.0)) / math.sqrt(2.0)
    assert off_the_block >= 0.2 + room(bench) - 1e-6
    assert math.dist((x, y), (0.1, 2.0)) < 0.2 + room(bench) + 0.1


def test_a_corner_that_is_built_over_stays_inside_the_lines(bench):
    bench.obstacles = (pillar(bench.pitch.goal_line, bench.pitch.touch_line, 1.0),)
    bench.playing()
    bench.ask("corner", Side.CYAN, place=(bench.pitch.goal_line, bench.pitch.touch_line))
    bench.until(lambda state: state.phase is Phase.CORNER)
    x, y = bench.state.spot
    assert abs(x) <= bench.pitch.goal_line and abs(y) <= bench.pitch.touch_line
    assert math.dist((x, y), (bench.pitch.goal_line, bench.pitch.touch_line)) >= 1.0 + room(bench)


def test_an_obstacle_that_leaves_the_spot_free_moves_nothing(bench):
    bench.obstacles = (pillar(0.5, 0.0),)
    bench.tick((3.0, 3.0))
    assert bench.state.spot == (0.0, 0.0)
    assert "obstacle" not in bench.events[-1].text


def test_an_obstacle_that_is_put_on_the_spot_after_the_signal_has_the_restart_signalled_beside_it(bench):
    bench.tick((3.0, 3.0))
    assert bench.state.spot == (0.0, 0.0)
    bench.obstacles = (pillar(0.0, 0.0),)
    ruling = bench.tick((0.0, 0.6))
    assert bench.state.spot != (0.0, 0.0)
    assert [event.kind for event in ruling.events] == [EventKind.RESTART]
    assert [(placed.x, placed.y) for placed in ruling.placements] == [bench.state.spot]
    spot = bench.state.spot
    bench.until(lambda state: state.running)
    assert bench.state.spot == spot
    assert [event.kind for event in bench.events].count(EventKind.RESTART) == 2


def test_a_pitch_without_free_ground_leaves_the_ball_where_the_rules_have_it(bench):
    bench.obstacles = (pillar(0.0, 0.0, 30.0),)
    bench.tick((3.0, 3.0))
    assert bench.state.spot == (0.0, 0.0)
    bench.until(lambda state: state.running)


def test_the_referee_is_told_that_a_place_is_taken(new_bench):
    bench = new_bench(mode=Mode.MANUAL)
    bench.ask("start")
    bench.ask("start")
    bench.playing()
    bench.obstacles = (pillar(2.0, 1.0),)
    bench.ask("stop")
    assert "an obstacle stands at" in bench.ask("place_ball", place=(2.1, 1.0)).replies[0].reason
    assert bench.ask("place_ball", place=(2.6, 1.0)).replies[0].accepted


def test_nobody_who_stood_wrong_is_set_down_in_an_obstacle(new_bench):
    """A wall on one side of the ball: whoever is moved goes to the other."""
    bench = new_bench()
    walls = tuple(pillar(x / 2, y, 0.25) for x in range(-12, 13) for y in (2.6, 3.1, 3.6))
    bench.tick((3.0, 3.0))
    bench.obstacles = walls
    assert bench.book.restarts.moves_offenders
    bench.robots["magenta3"] = (0.8, 1.0)
    bench.until(lambda state: state.running)
    x, y = bench.robots["magenta3"]
    assert all(math.dist((x, y), (wall.x, wall.y)) > wall.radius + bench.hull for wall in walls)
