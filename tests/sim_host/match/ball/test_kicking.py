"""Kicks in the world: exit speeds, lobs through air, charge and cooldown, and refusals with their reason."""

import math
from types import SimpleNamespace

import pytest
from pytest import approx

from robot_agent.soccer.skills.pass_to import pass_speed
from schemas.config.soccer.kicked import Kicked
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive, Kick, KickMode

WAYS = ("pose", "velocity", "force")


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("speed", [1.0, 5.0, 9.5])
def test_a_ground_kick_leaves_at_its_speed_along_the_axis_out_of_any_dribble(rig, build, tell, way, speed):
    """Equation 3 of the paper: within 1 % after one tick, allowing for one tick of rolling resistance."""
    rig = build(rig.profile.name, dribble={"method": way}, kicker={"kick_spin": 1.0})
    rig.give("cyan1", 0, 0, 0.7)
    rig.run(0.1, cyan1=tell(dribble=True))
    snapshot = rig.tick(cyan1=tell(kick=("ground", speed)))
    lost = rig.profile.ball.rolling_deceleration * rig.profile.time.tick
    assert snapshot.kicked == "cyan1"
    assert math.hypot(*snapshot.ball[3:5]) == approx(speed - lost, rel=0.01)
    assert math.atan2(snapshot.ball.vy, snapshot.ball.vx) == approx(0.7, abs=1e-3)


def height_at_the_goal(rig):
    """Where the ball's centre crosses the goal plane, m."""
    line, before = rig.profile.field.goal_line, rig.world.snapshot().ball
    for _ in range(400):
        after = rig.tick().ball
        if after.x >= line:
            return before.z + (line - before.x) / (after.x - before.x) * (after.z - before.z)
        before = after
    pytest.fail("the lob never came to the goal plane")


@pytest.mark.parametrize("speed", [2.0, 5.0, 8.0, 12.0])
@pytest.mark.parametrize(("d", "y", "heading"), [(1.5, 0.2, 0), (2.5, 0, 0), (5, 0.5, -0.1), (8, -1, 0.1), (12, 0, 0)])
def test_a_lob_crosses_the_goal_plane_within_a_balls_radius_of_the_papers_point(rig, tell, d, y, heading, speed):
    """Equations 4 to 12 of the paper, margin of its code, drag on in `msl`: below h, by a ball's radius at most."""
    goal_line, r = rig.profile.field.goal_line, rig.profile.ball.radius
    rig.give("cyan1", goal_line - d, y, heading)
    assert rig.tick(cyan1=tell(kick=("lob", speed))).kicked == "cyan1"
    h = rig.profile.field.goal_height - r - rig.profile.kicker.lob_margin
    assert h - r < height_at_the_goal(rig) < h + 0.005


def test_a_kick_before_cooldown_or_charge_is_refused_with_the_remaining_time(build, tell):
    """The profile's 0.2 s and 0.8 s, to the tick."""
    rig = build()
    tick, kicker = rig.profile.time.tick, rig.profile.kicker
    again = tell(dribble=True, kick=("ground", 3.0))
    rig.give("cyan1", 0)
    first = rig.tick(cyan1=again)
    assert first.kicked == "cyan1" and first.kickers_ready == (False, True, True, True)
    said, waited = [], 0
    while True:
        rig.give("cyan1", 0)
        snapshot = rig.tick(cyan1=again)
        waited += 1
        if snapshot.kicked:
            break
        said.append(rig.refused["cyan1"])
    assert waited * tick == approx(kicker.cooldown + kicker.charge_time)
    assert said[0] == "kick: cooling down, 0.98 s to go"
    assert said[-1] == "kick: charging, 0.02 s to go"
    assert sum("cooling" in reason for reason in said) == round(kicker.cooldown / tick) - 1


def test_the_papers_kicker_is_always_ready(build, tell):
    rig = build("paper")
    for _ in range(3):
        rig.give("cyan1", 0)
        snapshot = rig.tick(cyan1=tell(dribble=True, kick=("ground", 3.0)))
        assert snapshot.kicked == "cyan1" and all(snapshot.kickers_ready)


def test_a_refused_kick_costs_no_charge(build, tell):
    rig = build()
    rig.place(cyan1=(0, 0, 0), ball=(3, 0, 0))
    assert all(rig.tick(cyan1=tell(kick=("ground", 3.0))).kickers_ready)
    rig.give("cyan1", 0, 0, math.pi / 2)
    snapshot = rig.tick(cyan1=tell(kick=("lob", 8.0)))
    assert "aimed at a goal" in rig.refused["cyan1"] and all(snapshot.kickers_ready)
    assert snapshot.possession == "cyan1", "and the ball is still held"


@pytest.mark.parametrize(
    ("height", "place", "reason"),
    [(0.11, 0.45, "kick: ball not held"), (0.45, 0.35, "kick: ball in the air, 0.45 m high")],
)
def test_an_impossible_kick_is_refused_with_the_reason(build, tell, height, place, reason):
    rig = build()
    rig.place(cyan1=(0, 0, 0))
    rig.set_ball((place, 0, height))
    rig.tick(cyan1=tell(kick=("ground", 3.0)))
    assert rig.refused == {"cyan1": reason}


def test_a_kick_of_a_contested_ball_is_refused_with_that_reason(build, tell):
    rig = build()
    rig.place(cyan1=(-0.36, 0, 0), magenta1=(0.36, 0, math.pi), ball=(0, 0, 0))
    rig.tick(cyan1=tell(kick=("ground", 3.0)), magenta1=tell(dribble=True))
    assert rig.refused == {"cyan1": "kick: ball contested, another robot is equally near"}


def test_a_kick_against_a_touching_opponent_is_stopped_by_its_hull(rig, tell):
    """Nothing explodes: the ball is never faster than its kick, and never inside the opponent."""
    touching = rig.profile.robot.radius + rig.profile.ball.radius
    for mode in KickMode:
        rig.give("cyan1", 0)
        rig.place(magenta1=(rig.profile.dribble.gap + touching, 0, 0))
        told = AppliedInput(Drive(), dribble=False, kick=Kick(mode=mode, speed=10.0))
        rig.world.make_checkpoint()
        assert rig.tick(cyan1=told).kicked == "cyan1"
        for _ in range(50):
            snapshot = rig.tick()
            other = rig.at("magenta1")
            assert math.hypot(*snapshot.ball[3:]) < 12.0
            if snapshot.ball.z < rig.profile.robot.height:
                assert math.hypot(snapshot.ball.x - other.x, snapshot.ball.y - other.y) > touching - 0.03


@pytest.mark.parametrize("spin", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("speed", [3.0, 6.0, 10.0])
def test_a_kick_slides_until_it_rolls_as_robots_expect(build, tell, spin, speed):
    """Speed and way 0.1 to 1.2 s after the kick are those of `Kicked`, within 0.1 m/s and 5 cm."""
    rig = build(kicker={"kick_spin": spin})
    kicked = Kicked.of(rig.profile.ball, rig.profile.kicker)
    rig.give("cyan1", -7)
    start = rig.world.snapshot().ball.x
    rig.tick(cyan1=tell(kick=("ground", speed)))
    for tick in range(2, 61):
        ball = rig.tick().ball
        left, way = kicked.after(speed, tick * rig.profile.time.tick)
        assert tick < 5 or (ball.vx, ball.x - start) == (approx(left, abs=0.1), approx(way, abs=0.05))


@pytest.mark.parametrize("distance", [2.0, 3.5, 5.0])
def test_a_pass_arrives_at_the_speed_that_it_was_kicked_for(build, tell, distance):
    """3.5 m/s where the receiver stands, within 0.15 m/s: a kick that slid, and was planned as a rolling one, has 2."""
    rig = build()
    setup = SimpleNamespace(ball=rig.profile.ball, kicker=rig.profile.kicker)
    rig.give("cyan1", -7)
    start = rig.world.snapshot().ball.x
    ball = rig.tick(cyan1=tell(kick=("ground", pass_speed(distance, setup)))).ball
    while ball.x < start + distance:
        ball = rig.tick().ball
    assert ball.vx == approx(3.5, abs=0.15)


def test_a_robot_that_catches_up_with_the_ball_it_has_kicked_pushes_it_ahead(build, tell):
    """The kicked ball is slower than its kicker, before it has left the hull."""
    rig = build("paper")
    rig.give("cyan1", -5.0)
    rig.run(2.0, cyan1=tell(vx=3.0, dribble=True))
    rig.tick(cyan1=tell(vx=3.0, dribble=True, kick=("ground", 1.0)))
    for _ in range(25):
        snapshot = rig.tick(cyan1=tell(vx=3.0))
        ahead = snapshot.ball.x - rig.at("cyan1").x
        assert ahead > rig.profile.robot.radius
