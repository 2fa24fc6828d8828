"""The three ways to dribble: what they hold, what they lose, and that none takes the ball through a body."""

import math

import pytest
from pytest import approx

WAYS = ("pose", "velocity", "force")


def held_for(rig, tell, seconds, **motion):
    """How long cyan1 keeps the ball, s, and the farthest that it was from the gap, m."""
    ticks, worst = round(seconds / rig.profile.time.tick), 0.0
    for tick in range(ticks):
        snapshot = rig.tick(cyan1=tell(dribble=True, **motion))
        if snapshot.possession != "cyan1":
            return tick * rig.profile.time.tick, worst
        at, gap = rig.at("cyan1"), rig.profile.dribble.gap
        x, y = at.x + gap * math.cos(at.heading), at.y + gap * math.sin(at.heading)
        worst = max(worst, math.hypot(snapshot.ball.x - x, snapshot.ball.y - y))
    return math.inf, worst


@pytest.mark.parametrize("way", ["pose", "velocity"])
@pytest.mark.parametrize("backward", [1, -1])
def test_the_papers_ways_keep_the_ball_at_top_speed_and_turn_rate(rig, build, tell, way, backward):
    """Equation 2 of the paper, within 2 cm of the gap for three seconds of the hardest driving."""
    rig = build(rig.profile.name, dribble={"method": way})
    top = rig.profile.drive
    rig.give("cyan1", -2)
    kept, worst = held_for(rig, tell, 3.0, vx=backward * top.max_speed, omega=top.max_turn_rate)
    assert kept == math.inf and worst < 0.02


def test_a_ball_drawn_by_forces_rolls_on_the_ground_and_lies_against_the_hull(rig, build, tell):
    rig = build(rig.profile.name, dribble={"method": "force"})
    robot, r = rig.profile.robot, rig.profile.ball.radius
    rig.give("cyan1", -4)
    snapshot = rig.run(2.0, cyan1=tell(2.0, dribble=True))
    at, ball = rig.at("cyan1"), snapshot.ball
    assert snapshot.possession == "cyan1"
    assert ball.z == approx(r, abs=1e-3)
    assert math.hypot(ball.x - at.x, ball.y - at.y) == approx(robot.radius + r, abs=0.003)
    assert rig.engine.ball_now().spin[1] == approx(ball.vx / r, rel=0.05)


def overlap_with(rig, snapshot, what):
    """How deep the ball is in another body, m; negative in the open."""
    field, r, (x, y, *_) = rig.profile.field, rig.profile.ball.radius, snapshot.ball
    if what == "wall":
        return x + r - field.goal_line - field.border
    if what == "post":
        half = field.post / 2
        dx, dy = abs(x - field.goal_line - half) - half, abs(y - field.goal_width / 2 - half) - half
        return r - math.hypot(max(dx, 0.0), max(dy, 0.0))
    other = rig.at("magenta1")
    return r + rig.profile.robot.radius - math.hypot(x - other.x, y - other.y)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("what", ["standing robot", "oncoming robot", "robot at the edge", "post", "wall"])
def test_no_way_takes_the_ball_through_a_body(rig, build, tell, way, what):
    """At top speed for three seconds, never more than 3 cm deep, and nothing explodes."""
    rig = build(rig.profile.name, dribble={"method": way})
    field, top = rig.profile.field, rig.profile.drive.max_speed
    rig.give("cyan1", {"post": field.goal_line - 2, "wall": field.goal_line - 1}.get(what, -1.5))
    if what == "post":
        rig.give("cyan1", field.goal_line - 2, (field.goal_width + field.post) / 2)
    elif what == "wall":
        rig.give("cyan1", field.goal_line - 1, 4.0)
    else:
        aside = 0.9 * rig.profile.robot.radius if what == "robot at the edge" else 0.0
        rig.place(magenta1=(1.5, aside, math.pi))
    for _ in range(round(3 / rig.profile.time.tick)):
        told = {"magenta1": tell(top)} if what == "oncoming robot" else {}
        snapshot = rig.tick(cyan1=tell(top, dribble=True), **told)
        assert overlap_with(rig, snapshot, what) < 0.03
        assert math.hypot(*snapshot.ball[3:]) < 2.5 * top
        assert snapshot.ball.z < 1.0


@pytest.mark.parametrize("way", WAYS)
def test_a_ball_beside_its_place_is_drawn_there_and_does_not_jump(rig, build, tell, way):
    """From the edge of the cone, at no more than 2 m/s beside the robot's own motion."""
    rig = build(rig.profile.name, dribble={"method": way})
    dribble, r = rig.profile.dribble, rig.profile.ball.radius
    away, bearing = dribble.distance - 0.005, dribble.cone / 2 - 0.02
    rig.place(cyan1=(0, 0, 0))
    rig.set_ball((away * math.cos(bearing), away * math.sin(bearing), r))
    x, y = away * math.cos(bearing), away * math.sin(bearing)
    for _ in range(30):
        ball = rig.tick(cyan1=tell(dribble=True)).ball
        assert math.hypot(ball.x - x, ball.y - y) <= 2.0 * rig.profile.time.tick * 1.05
        x, y = ball.x, ball.y
    assert (x, y) == approx((dribble.gap, 0), abs=0.02)


def test_a_ball_between_two_robots_that_press_is_never_thrown(rig, build, tell):
    """Squeezed head-on at full drive for three seconds: it slips out like a pip, at three times their speed at most."""
    rig = build(rig.profile.name)
    top = rig.profile.drive.max_speed
    away = rig.profile.robot.radius + rig.profile.ball.radius + 0.4
    for offset in (0.0, 0.03, 0.1):
        rig.place(cyan1=(-away, 0, 0), magenta1=(away, offset, math.pi), ball=(0, 0, 0))
        for _ in range(round(3 / rig.profile.time.tick)):
            snapshot = rig.tick(cyan1=tell(top), magenta1=tell(top))
            assert math.hypot(*snapshot.ball[3:]) < 3 * top and snapshot.ball.z < 1.0


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("bearing", [0.0, 1.5, *(pytest.param(one, marks=pytest.mark.long) for one in (0.5, 1.0))])
def test_a_ball_that_an_opponent_presses_is_not_pumped_into_it(rig, build, tell, way, bearing):
    """A robot that carries the ball loses it to the press, and does not catch it again while the press lasts.

    Within 2 cm, although the carrier drives on and wants the ball in every tick.
    """
    rig = build(rig.profile.name, dribble={"method": way})
    touching = rig.profile.robot.radius + rig.profile.ball.radius
    x, y = touching * math.cos(bearing) + 0.05, touching * math.sin(bearing)
    rig.place(cyan1=(-rig.profile.dribble.gap, 0, 0), ball=(0, 0, 0), magenta1=(x, y, math.pi + bearing))
    for _ in range(round(2.0 / rig.profile.time.tick)):
        snapshot = rig.tick(cyan1=tell(0.5, dribble=True), magenta1=tell(0.5))
        assert overlap_with(rig, snapshot, "magenta1") < 0.02


@pytest.mark.parametrize("way", ["pose", "velocity"])
@pytest.mark.parametrize(("deeper", "held"), [(0.005, True), (0.02, False)])
def test_a_ball_that_its_holder_has_run_over_is_released(build, tell, way, deeper, held):
    rig = build(dribble={"method": way})
    rig.give("cyan1", 0.0)
    assert rig.run(0.1, cyan1=tell(dribble=True)).possession == "cyan1"
    robot, gap, r = rig.at("cyan1"), rig.profile.dribble.gap, rig.profile.ball.radius
    rig.engine.set_ball_state((robot.x + gap - deeper, robot.y, r), (0, 0, 0), (0, 0, 0))
    rig.engine.read()
    assert rig.tick(cyan1=tell(dribble=True)).possession == ("cyan1" if held else None)
