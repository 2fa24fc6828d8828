"""Where a ball that bounded forces hold is lost, in each direction, against closed forms.

A rolling ball resists a change of its velocity with m' = m + I/r². `max_pull` acts along the kick axis, `max_side`
across it. Resistance a_r helps to brake the ball, and hinders any drawing of it. There is no air in these worlds, and
`max_side` is small enough for the ball to roll: drawn with more than μ·m·g·(1 + m·r²/I), 6.1 N, it slides.
"""

import math
from itertools import pairwise

import pytest

from schemas.config.profile import load_profile
from sim_host.soccer.ball.possession import can_hold

MSL = load_profile("msl")
RESISTS = MSL.ball.mass + MSL.ball.inertia / MSL.ball.radius**2
MAX_SIDE = 5.0
PULL, SIDE = MSL.dribble.max_pull / RESISTS, MAX_SIDE / RESISTS
"""m/s² that the dribbler gives the ball along and across the kick axis."""
ROLLING, GAP = MSL.ball.rolling_deceleration, MSL.dribble.gap
NO_AIR = {"air_density": 0.0}


@pytest.fixture
def driven(build, tell):
    """Whether a robot keeps the ball through phases of (seconds, motion); the ball is at its gap at the beginning."""

    def run(phases, heading=0.0, **drive):
        rig = build(ball=NO_AIR, drive=drive, dribble={"max_side": MAX_SIDE})
        rig.give("cyan1", 0, 0, heading)
        for seconds, motion in phases:
            for _ in range(round(seconds / rig.profile.time.tick)):
                if rig.tick(cyan1=tell(dribble=True, **motion)).possession != "cyan1":
                    return False
        return True

    return run


def brake(driven, limit):
    """From 4 m/s to rest."""
    motion = {"acceleration": 2.0, "deceleration": limit}
    return driven([(2.1, {"vx": 4.0}), (4.0 / limit + 0.3, {"vx": 0.0})], **motion)


def backward(driven, limit):
    """From rest to 5 m/s."""
    return driven([(5.0 / limit, {"vx": -5.0})], heading=math.pi, max_speed=5.0, acceleration=limit)


def sideways(driven, limit):
    """From rest to 12 m/s."""
    motion = {"acceleration": limit, "deceleration": limit, "max_speed": 12.0}
    return driven([(12.0 / limit, {"vy": 12.0})], heading=math.pi / 2, **motion)


def on_the_spot(driven, limit):
    """Turn ever faster, and keep the turn rate for 3 s."""
    return driven([(limit / 3.0 + 3.0, {"omega": limit})], turn_acceleration=3.0)


def in_a_turn(driven, limit, speed=4.0):
    """The same at 4 m/s, with a drive that costs no grip."""
    motion = {"model": "velocity", "turn_acceleration": 1.0}
    return driven([(1.6, {"vx": speed}), (limit + 3.0, {"vx": speed, "omega": limit})], **motion)


def in_a_slow_turn(driven, limit):
    """At 2 m/s, where the limit is nearly that on the spot."""
    return in_a_turn(driven, limit, 2.0)


LIMITS = {
    "brake": (brake, PULL + ROLLING, 0.03),
    "backward": (backward, PULL - ROLLING, 0.04),
    "sideways": (sideways, SIDE - ROLLING, 0.05),
    "on the spot": (on_the_spot, math.sqrt(PULL / GAP), 0.04),
    "in a turn": (in_a_turn, SIDE / 4.0, 0.07),
    "in a slow turn": (in_a_slow_turn, SIDE / 2.0, 0.09),
}
"""Way to lose the ball → the drive to its limit, the closed form in m/s² or rad/s, and by which share it may err."""


@pytest.mark.parametrize("way", LIMITS)
def test_the_ball_leaves_where_the_pull_it_needs_exceeds_what_the_dribbler_gives(driven, way):
    """Kept a little below the closed form, lost a little above it."""
    drive_to, limit, share = LIMITS[way]
    assert drive_to(driven, limit * (1 - share))
    assert not drive_to(driven, limit * (1 + share))


@pytest.mark.parametrize("gain", [2.5, 5.0, 20.0])
def test_no_acceleration_forward_loses_the_ball(driven, gain):
    """The hull pushes it, as hard as it must."""
    assert driven([(4.0 / gain + 0.5, {"vx": 4.0})], acceleration=gain, deceleration=20.0)


@pytest.mark.parametrize(
    "motion", [{"vx": 4.0}, {"vx": -1.0}, {"vy": 3.0}, {"omega": 3.0}, {"vx": 2.0, "omega": 2.0}, {"vx": -1, "vy": 2}]
)
def test_a_held_ball_is_never_deeper_in_the_hull_than_the_league_allows(build, tell, motion):
    """The league allows a third of the diameter, 7.3 cm; the hull has no recess, and yields by less than 6 mm."""
    rig = build()
    rig.give("cyan1", 0)
    touching = rig.profile.robot.radius + rig.profile.ball.radius
    depths = []
    for tick in range(75):
        told = tell(dribble=True, **(motion if tick < 40 else {}))
        ball, at = rig.tick(cyan1=told).ball, rig.at("cyan1")
        depths.append(touching - math.hypot(ball.x - at.x, ball.y - at.y))
    assert max(depths) < 0.006 < 2 * rig.profile.ball.radius / 3


@pytest.mark.parametrize("bearing", [0.2, 0.5, 1.5, 3.0])
@pytest.mark.parametrize("speed", [0.5, 3.0])
def test_a_robot_that_meets_the_ball_outside_its_cone_does_not_hold_it(build, tell, bearing, speed):
    """Half of the cone is 0.17 rad: beside it the hull pushes the ball away, whatever the dribbler does."""
    rig = build()
    rig.place(cyan1=(-1.5, 0, bearing), ball=(0, 0, 0))
    along = {"vx": speed * math.cos(bearing), "vy": -speed * math.sin(bearing)}
    while not (snapshot := rig.tick(cyan1=tell(dribble=True, **along))).touches:
        assert snapshot.possession is None
    held = {rig.tick(cyan1=tell(dribble=True, **along)).possession for _ in range(5)}
    assert held == {None}
    assert rig.world.snapshot().ball.vx > 0.7 * speed


def test_a_ball_that_leaves_is_not_thrown(build, tell):
    """A robot that brakes too hard loses the ball at the speed that it had, and follows it no more."""
    rig = build(ball=NO_AIR, drive={"deceleration": 8.0})
    rig.give("cyan1", -8)
    rig.run(1.8, cyan1=tell(3.0, dribble=True))
    speeds = [math.hypot(*rig.tick(cyan1=tell(dribble=True)).ball[3:5]) for _ in range(50)]
    assert all(after <= before + 0.02 for before, after in pairwise(speeds))
    assert speeds[-1] > 1.0


def test_the_ball_has_no_holder_any_more_in_the_tick_in_which_it_leaves_it(build, tell):
    """A brake that is too hard; whoever holds the ball at the end of a tick fulfils the hold condition there."""
    rig = build(ball=NO_AIR, drive={"deceleration": 9.0})
    rig.give("cyan1", -5.0, 0)
    rig.run(2.0, cyan1=tell(vx=4.0, dribble=True))
    for _ in range(50):
        snapshot = rig.tick(cyan1=tell(dribble=True))
        if snapshot.possession is None:
            break
        assert can_hold(rig.at("cyan1"), snapshot.ball, rig.profile.dribble)
    assert snapshot.possession is None and not can_hold(rig.at("cyan1"), snapshot.ball, rig.profile.dribble)
