"""A mirrored match has the mirrored decisions, also when several robots offend in the same tick.

In a mirrored match each robot does what its counterpart of the other colour does, turned by π about the centre mark.
"""

import math
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from schemas.config.obstacle import Shape
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from sim_host.snapshot import ObstacleState
from sim_host.soccer.referee.placement.spots import restart_at

NAMES = tuple(f"{side}{number}" for side in Side for number in range(1, 6))


POSES = st.tuples(st.sampled_from([9.5, 10.6, 12.0, -9.5, -10.6, -12.0]), st.sampled_from([-7.6, -1.0, 0.0, 1.0, 7.6]))


@settings(max_examples=25)
@given(
    rules=st.sampled_from(["msl", "china-sim-2020"]),
    places=st.dictionaries(st.sampled_from([name for name in NAMES if name[-1] != "1"]), POSES, min_size=2, max_size=6),
    pushes=st.lists(st.sampled_from([("cyan2", "magenta3"), ("magenta4", "cyan5"), ("cyan3", "magenta2")]), max_size=3),
    ball=st.sampled_from([(0.5, 0.3), (8.0, -2.0), (-9.0, 6.0)]),
    kick_off=st.sampled_from(Side),
)
def test_of_several_offences_in_one_tick_the_mirrored_one_is_decided_in_the_mirrored_match(
    new_rig, rules, places, pushes, ball, kick_off
) -> None:
    """Robots in goal areas, in crowds, outside the field and in pushes, all from the same tick on."""
    told = []
    for is_mirrored in (False, True):
        rig = new_rig("msl", rules, dt=0.1, duration=60.0, mirrored=is_mirrored, kick_off=kick_off)
        rig.playing(ball)
        rig.robots |= places
        seen = {"contacts": pushes, "motions": {name: (0.0, 0.3, 0.2) for pair in pushes for name in pair}}
        for _ in range(150):
            if rig.state.phase is not Phase.PLAY:
                break
            rig.tick(ball, **seen)
        rig.run(5.0)
        told.append([rig.unmirrored(event) for event in rig.events])
    assert told[0] == told[1]


def last_stop(rig) -> Iterator[GameEvent]:
    return (event for event in reversed(rig.events) if event.kind in (EventKind.FOUL, EventKind.STALL))


@pytest.mark.parametrize(("near", "blamed"), [("cyan", "cyan3"), ("magenta", "magenta3")])
def test_of_two_robots_that_left_the_field_together_the_one_nearer_to_the_ball_is_blamed(new_rig, near, blamed) -> None:
    rig = new_rig("msl", "msl", dt=0.1, duration=60.0)
    rig.playing((0.0, 6.5))
    rig.robots |= {"cyan3": (-0.5 if near == "cyan" else -0.9, 7.6), "magenta3": (0.7, 7.6)}
    for _ in range(200):
        rig.tick((0.0, 6.5))
        if rig.state.phase is not Phase.PLAY:
            break
    assert next(last_stop(rig)).robot == blamed


@pytest.mark.parametrize("kick_off", Side)
def test_of_two_equal_offences_the_side_that_kicked_off_is_blamed_whichever_it_is(new_rig, kick_off) -> None:
    rig = new_rig("msl", "msl", dt=0.1, duration=60.0, kick_off=kick_off)
    rig.playing((0.0, 6.5))
    rig.robots |= {"cyan3": (-0.7, 7.6), "magenta3": (0.7, 7.6)}
    for _ in range(200):
        rig.tick((0.0, 6.5))
        if rig.state.phase is not Phase.PLAY:
            break
    assert next(last_stop(rig)).robot == f"{kick_off}3"


def test_robots_of_both_sides_whose_time_is_up_come_back_in_the_same_tick(new_rig) -> None:
    rig = new_rig("msl", "msl", dt=0.1, duration=60.0)
    rig.playing()
    for side in Side:
        rig.ask("repair", robot=f"{side}3")
    rig.run(rig.book.people.repair)
    rig.ask("stop")
    rig.run(1.0)
    back = {event.robot: event.tick for event in rig.events if event.kind is EventKind.ON_FIELD}
    assert set(back) == {"cyan3", "magenta3"} and len(set(back.values())) == 1


@pytest.mark.parametrize("near", ["cyan3", "magenta3"])
def test_of_robots_in_wrong_positions_the_last_offender_is_the_one_nearest_to_the_ball(new_rig, near) -> None:
    """An unnamed card of a referee box goes to the last offender."""
    rig = new_rig("msl", "msl", dt=0.1, duration=60.0)
    rig.playing()
    rig.ask("free_kick", Side.CYAN, (0.0, 0.0))
    rig.robots |= {"cyan4": (-0.7, 0.0), "cyan3": (0.0, -1.2), "magenta3": (0.0, 1.2)} | {
        near: (0.0, math.copysign(1.0, rig.robots[near][1]))
    }
    rig.until(lambda state: state.running)
    faults = [event.robot for event in rig.events if event.rule == "positions" and event.kind is EventKind.FOUL]
    assert set(faults) == {"cyan3", "magenta3"} and faults[-1] == near == rig.state.offender


@pytest.mark.parametrize("name", ["kick_off", "penalty", "free_kick"])
@pytest.mark.parametrize("side", Side)
def test_a_restart_moves_from_an_obstacle_to_the_mirrored_place_in_the_mirrored_match(new_rig, name, side) -> None:
    spots = []
    for is_mirrored in (False, True):
        rig = new_rig("msl", "msl", dt=0.1, duration=60.0, mirrored=is_mirrored)
        rig.playing()
        sign = -1 if is_mirrored else 1
        mark = {"penalty": rig.state.attack(rig.side(side)) * (rig.pitch.goal_line - rig.pitch.penalty_mark)}
        x = mark.get(name, 0.0)
        rig.obstacles = (ObstacleState("crate", x, 0.0, 0.0, 0.3, 0.5, Shape.CYLINDER, 0.6, 0.6),)
        rig.ask(name, side, (0.0, 0.0) if name == "free_kick" else None)
        rig.until(lambda state: state.restart is not None)
        spots.append((sign * rig.state.spot[0], sign * rig.state.spot[1]))
    assert spots[0] == pytest.approx(spots[1]) and math.hypot(spots[0][0] - mark.get(name, 0.0), spots[0][1]) > 0.3


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
def test_a_place_between_two_restart_spots_leads_to_the_mirrored_spot_in_the_mirrored_match(new_rig, share) -> None:
    rig = new_rig("msl", "msl", dt=0.1)
    mark = rig.pitch.goal_line - rig.pitch.penalty_mark
    spots = []
    for sign in (1, -1):
        attack = {1: Side.MAGENTA, -1: Side.CYAN}[sign]
        place = (sign * share * mark, 1.0 * sign)
        spots.append(restart_at(rig.constants, rig.state, Phase.GOAL_KICK, attack, place).spot)
    assert spots[0] == (-spots[1][0], -spots[1][1])
