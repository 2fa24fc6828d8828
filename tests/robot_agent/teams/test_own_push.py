"""A robot lets go of an opponent that it pushes, before the referee calls it."""

import math
from dataclasses import replace

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.teams.own_push import APART, OwnPush, let_go_of_opponent, push_after
from schemas.messages.command import Drive
from schemas.messages.setup import Setup
from support.messages import make_setup

REACH = 0.245
TICK = 0.02
AHEAD = Drive(vx=2.0)


def pushed(seconds: float, speed: float, push: OwnPush | None = None) -> OwnPush:
    """The push after both have driven on along +x in contact for so long."""
    push = push if push is not None else OwnPush()
    for _ in range(round(seconds / TICK)):
        push = push_after(push, Body(0.0, 0.0, 0.0, speed, 0.0), [(0.5, 0.0), (3.0, 0.0)], TICK, REACH)
    return push


def test_the_way_of_a_push_is_that_of_the_robot_toward_the_opponent() -> None:
    assert pushed(0.2, 1.5).way == pytest.approx(0.3)
    assert pushed(0.2, -1.5).way == pytest.approx(-0.3)


def test_robots_side_by_side_do_not_push() -> None:
    push = push_after(OwnPush(), Body(0.0, 0.0, 0.0, 3.0, 0.0), [(0.0, 0.5)], TICK, REACH)
    assert push.way == pytest.approx(0.0)


def test_a_push_is_over_once_the_robots_were_apart_for_a_moment() -> None:
    push = pushed(0.2, 1.5)
    me = Body(0.0, 0.0, 0.0, 1.5, 0.0)
    assert push_after(push, me, [(0.8, 0.0)], 0.5 * APART, REACH).way == push.way
    assert push_after(push, me, [(0.8, 0.0)], 2.0 * APART, REACH).way == 0.0
    assert push_after(push, me, [], 2.0 * APART, REACH).way == 0.0


def test_it_drives_on_while_the_way_is_short_and_away_from_the_opponent_after_that() -> None:
    setup = make_setup(rules="msl")
    limits, me = DriveLimits.of(setup), Body(0.0, 0.0, 0.0, 1.5, 0.0)
    assert let_go_of_opponent(pushed(0.1, 1.5), me, AHEAD, setup, limits) == AHEAD
    assert let_go_of_opponent(pushed(0.2, 1.5), me, AHEAD, setup, limits).vx < 0.0
    across = Body(0.0, 0.0, math.pi / 2, 1.5, 0.0)
    assert let_go_of_opponent(pushed(0.2, 1.5), across, AHEAD, setup, limits).vx == pytest.approx(AHEAD.vx)


def test_without_a_rule_it_goes_on(setup: Setup) -> None:
    me, limits = Body(0.0, 0.0, 0.0, 1.5, 0.0), DriveLimits.of(setup)
    free = setup.replace(fouls=replace(setup.fouls, pushing="off"))
    assert let_go_of_opponent(pushed(1.0, 1.5), me, AHEAD, free, limits) == AHEAD
