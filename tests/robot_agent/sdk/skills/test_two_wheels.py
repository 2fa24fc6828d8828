"""Skills of motion on a robot that cannot move sideways."""

import math
from collections.abc import Callable
from itertools import pairwise

import pytest
from pytest import approx

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.avoid import Circle, go_around
from robot_agent.sdk.skills.circle import circle
from robot_agent.sdk.skills.go_to import go_to
from robot_agent.sdk.skills.keep_out import Area, keep_out
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.frames import wrap
from schemas.messages.command import Drive
from schemas.messages.setup import Setup

SETUP = Setup.of(load_match(None, {}), load_profile("differential"), load_rule_book("msl"))
LIMITS = DriveLimits.of(SETUP)


def follow(me: Body, skill: Callable[[Body], Drive], seconds: float) -> list[Body]:
    """The path of a robot on two wheels under a skill, within its accelerations."""
    speed, path = 0.0, [me]
    for _ in range(round(seconds / LIMITS.tick)):
        demand = skill(me)
        assert demand.vy == 0.0
        most = LIMITS.acceleration * LIMITS.tick
        speed += max(-most, min(most, demand.vx - speed))
        most = LIMITS.turn_acceleration * LIMITS.tick
        omega = me.omega + max(-most, min(most, demand.omega - me.omega))
        heading = wrap(me.heading + omega * LIMITS.tick)
        vx, vy = speed * math.cos(heading), speed * math.sin(heading)
        me = Body(me.x + vx * LIMITS.tick, me.y + vy * LIMITS.tick, heading, vx, vy, omega)
        path.append(me)
    return path


def test_the_limits_say_whether_a_robot_moves_sideways() -> None:
    assert not LIMITS.sideways
    assert DriveLimits.of(Setup.of(load_match(None, {}), load_profile("msl"), load_rule_book("msl"))).sideways


@pytest.mark.parametrize("direction", range(0, 360, 45))
@pytest.mark.parametrize("heading", [0.0, 2.5])
def test_go_to_reaches_a_place_in_any_direction_and_then_the_heading(direction: int, heading: float) -> None:
    x, y = 2.0 * math.cos(math.radians(direction)), 2.0 * math.sin(math.radians(direction))
    end = follow(Body(0, 0, 0), lambda me: go_to(me, x, y, heading, LIMITS), 6.0)[-1]
    assert (end.x, end.y) == approx((x, y), abs=0.05)
    assert wrap(end.heading - heading) == approx(0, abs=0.03)


def test_a_place_behind_is_reached_backward() -> None:
    path = follow(Body(0, 0, 0), lambda me: go_to(me, -1.0, 0.1, 0.0, LIMITS), 4.0)
    assert max(abs(me.heading) for me in path) < 0.5
    assert (path[-1].x, path[-1].y) == approx((-1.0, 0.1), abs=0.05)


def test_obstacles_are_driven_around() -> None:
    blocked = [Circle(2.0, 0.1, 0.6)]
    path = follow(Body(0, 0, 0), lambda me: go_around(me, 4.0, 0.0, 0.0, blocked, LIMITS), 8.0)
    assert min(math.hypot(me.x - 2.0, me.y - 0.1) for me in path) > 0.5
    assert (path[-1].x, path[-1].y) == approx((4.0, 0.0), abs=0.05)


def test_a_circle_is_driven_round() -> None:
    path = follow(Body(2.0, 0, math.pi / 2), lambda me: circle(me, (0, 0), 2.0, LIMITS), 15.0)
    assert all(math.hypot(me.x, me.y) == approx(2.0, abs=0.25) for me in path)
    assert sum(wrap(b.heading - a.heading) for a, b in pairwise(path)) > 2 * math.pi


def test_the_goal_area_is_kept_out_of() -> None:
    area = Area.goal(SETUP.pitch)

    def skill(me: Body) -> Drive:
        return keep_out(me, go_to(me, 11.0, 0.0, 0.0, LIMITS), area, LIMITS)

    path = follow(Body(7.0, 0.5, 0.0), skill, 6.0)
    assert not any(area.has(1.0, me.x, me.y) for me in path)
    assert path[-1].x > 9.5
