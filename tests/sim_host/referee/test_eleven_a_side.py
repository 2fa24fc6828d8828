"""The referee with eleven robots a side: places for all of them, on the field and beside it."""

import itertools
import math

import pytest

from schemas.game import GameStage, Phase
from schemas.side import Side
from sim_host.referee.placement.positions import position_faults
from support.referee_rig import RefereeRig

RESTARTS = {
    "kick_off": None,
    "free_kick": (3.0, 2.0),
    "goal_kick": (-7.0, 0.0),
    "throw_in": (4.0, 6.0),
    "corner": (8.0, 5.0),
    "penalty": None,
    "drop_ball": (-2.0, -3.0),
}
"""Action → place that is named, m."""


def crowd(rig, spot):
    """All robots in rows around a spot, nearly touching each other."""
    apart = 2.0 * rig.hull + 0.05
    for place, name in enumerate(rig.roster.names):
        row, column = divmod(place, 6)
        rig.robots[name] = (spot[0] + apart * (column - 2.5), spot[1] + apart * (row - 1.5))


def assert_apart(rig):
    for (one, at), (other, there) in itertools.combinations(rig.robots.items(), 2):
        assert math.dist(at, there) >= 2.0 * rig.hull, f"{one} overlaps {other}"


def assert_all_are_moved(rig):
    """From a crowd around the ball, to legal positions apart from each other."""
    restart = rig.state.restart
    crowd(rig, restart.spot)
    rig.until(lambda state: state.running, rig.book.restarts.positions_limit + 5.0)
    assert_apart(rig)
    assert position_faults(rig.constants, rig.state, restart, rig.snapshot()) == ()
    assert len({event.robot for event in rig.events if event.rule == "positions"}) > 10


@pytest.mark.parametrize("profile", ["msl", "paper"])
@pytest.mark.parametrize("action", RESTARTS)
def test_a_crowd_of_twenty_two_is_moved_to_legal_positions_apart_from_each_other(profile, action):
    rig = RefereeRig(profile, "eleven", size=11)
    rig.playing()
    rig.ask("stop")
    (reply,) = rig.ask(action, None if action == "drop_ball" else Side.CYAN, RESTARTS[action]).replies
    assert reply.accepted, reply.reason
    rig.until(lambda state: state.phase is Phase(action))
    assert_all_are_moved(rig)


@pytest.mark.parametrize("profile", ["msl", "paper"])
def test_at_a_shoot_out_twenty_robots_have_legal_places_beyond_the_halfway_line(profile):
    rig = RefereeRig(profile, "eleven", size=11, winner=True, duration=2.0)
    rig.until(lambda state: state.stage is GameStage.SHOOT_OUT and state.phase is Phase.PENALTY, 400.0)
    assert_all_are_moved(rig)
