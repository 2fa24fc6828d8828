"""The physical world against closed forms, for both profiles."""

import math
from collections.abc import Iterator

import pytest
from pytest import approx

from schemas.config.profile import load_profile
from support.world_rig import WorldRig
from support.world_rig import tell as drive


@pytest.fixture(params=["msl", "paper"])
def rig(request: pytest.FixtureRequest) -> Iterator[WorldRig]:
    rig = WorldRig(load_profile(request.param))
    yield rig
    rig.world.close()


@pytest.mark.parametrize(("y", "z"), [("post", 0.2), ("over", 1.6)])
def test_a_ball_on_the_post_or_over_the_bar_does_not_end_in_the_goal(rig: WorldRig, y: str, z: float) -> None:
    field, r = rig.profile.field, rig.profile.ball.radius
    at = field.goal_width / 2 + field.post / 2 if y == "post" else 0.0
    rig.engine.set_ball_state((field.goal_line - 0.6, at, z), (10, 0, 0), (0, 0, 0))
    for _ in range(100):
        ball = rig.tick().ball
        deep = field.goal_line + r < ball.x < field.goal_line + field.goal_depth
        inside = deep and abs(ball.y) < field.goal_width / 2 and ball.z < field.goal_height
        assert not inside


def test_a_ball_that_is_not_asked_for_is_not_held(rig: WorldRig) -> None:
    rig.give("cyan1", 0.0)
    assert rig.tick().possession is None
    assert rig.tick(cyan1=drive(dribble=True)).possession == "cyan1"
    assert rig.tick().possession is None


def test_a_kick_without_the_ball_is_refused_now_and_not_kept_for_later(rig: WorldRig) -> None:
    """In the NuBot simulation an accepted kick waits until the ball is held again."""
    rig.place(cyan1=(0, 0, 0), ball=(3, 0, 0))
    rig.tick(cyan1=drive(kick=("ground", 5.0)))
    assert rig.refused == {"cyan1": "kick: ball not held"}
    rig.give("cyan1", 0.0)
    snapshot = rig.run(0.2, cyan1=drive(dribble=True))
    assert snapshot.possession == "cyan1" and snapshot.ball.vx == approx(0, abs=0.01)


@pytest.mark.parametrize(("apart", "touch"), [(0.01, True), (0.2, False)])
def test_the_snapshot_has_the_pairs_of_robots_that_touch(rig: WorldRig, apart: float, touch: bool) -> None:
    """Pairs of places in the roster, the first one first; a robot that presses against another touches it."""
    away = rig.profile.robot.radius + 0.5 * apart
    rig.place(cyan2=(away, 0, math.pi), magenta1=(-away, 0, 0), ball=(0, 4, 0))
    told = {"cyan2": drive(vx=0.3 * touch), "magenta1": drive(vx=0.3 * touch)}
    assert rig.run(0.5, **told).contacts == (((1, 2),) if touch else ())


def test_the_snapshot_has_the_spin_of_a_ball_that_rolls(rig: WorldRig) -> None:
    """A ball that rolls turns at its speed over its radius, about the axis to the left of its way."""
    radius = rig.profile.ball.radius
    rig.engine.set_ball_motion((1.2, 0.5, 0.0), (-0.5 / radius, 1.2 / radius, 0.0))
    snapshot = rig.tick()
    ball = snapshot.ball
    assert snapshot.ball_spin == approx((-ball.vy / radius, ball.vx / radius), rel=0.02)


def test_a_world_in_the_memory_of_a_closed_one_has_the_same_history() -> None:
    """A used engine has had other bodies and contacts; of two that are open, one at least had memory of its own."""
    profile = load_profile("msl")
    histories, clients = [], []
    other = WorldRig(profile)
    for _ in range(2):
        rig = WorldRig(profile)
        rig.place(cyan1=(-0.5, 0, 0), cyan2=(0, 0.6, -1.5), magenta1=(0.9, 0.1, math.pi), ball=(0.2, 0, 0))
        told = {name: drive(vx=2.0, omega=0.5, dribble=True) for name in rig.roster.names}
        histories.append([(rig.tick(**told).contacts, rig.world.chain()) for _ in range(60)])
        clients.append(rig.engine.client)
        rig.world.close()
    other.world.close()
    assert clients[0] == clients[1] and histories[0] == histories[1]
    assert any(touching for touching, _ in histories[0])
