"""Impacts of robots: reported in the tick in which they happen, with the velocities before it."""

import pytest

from schemas.config.profile import load_profile
from support.world_rig import WorldRig, tell

PHASES = [0.0, 0.013, 0.031, 0.047, 0.06]
"""m; where a robot begins, so that it arrives at all moments of a tick."""


def impacts_of(rig, ticks=500, **inputs):
    """The impacts of the first tick that has any."""
    for _ in range(ticks):
        found = rig.tick(**inputs).impacts
        if found:
            return found
    raise AssertionError("no impact")


@pytest.mark.parametrize("profile", ["msl", "ideal", "omni", "paper"])
@pytest.mark.parametrize("speed", [1.5, *(pytest.param(one, marks=pytest.mark.long) for one in (1.0, 3.0))])
@pytest.mark.parametrize("phase", PHASES)
def test_an_impact_has_the_velocities_before_it_whenever_in_a_tick_it_happens(profile, speed, phase):
    """On wheels, two robots often part again before the end of the tick, which then shows no contact."""
    rig = WorldRig(load_profile(profile))
    rig.place(cyan2=(-3.0 + phase, 0, 0), magenta2=(0, 0, 0), ball=(3, 3, 0))
    (impact,) = impacts_of(rig, cyan2=tell(vx=speed))
    names = rig.roster.names
    assert (names[impact.first], names[impact.second]) == ("cyan2", "magenta2")
    assert impact.first_speed == pytest.approx(speed, rel=0.02)
    assert impact.second_speed == pytest.approx(0.0, abs=0.01)
    assert impact.direction == pytest.approx((1.0, 0.0), abs=0.05)


def test_head_on_both_speeds_count_toward_the_other():
    rig = WorldRig(load_profile("msl"))
    rig.place(cyan2=(-3, 0, 0), magenta2=(3, 0, 3.14159), ball=(3, 3, 0))
    (impact,) = impacts_of(rig, cyan2=tell(vx=2.0), magenta2=tell(vx=1.0))
    assert (impact.first_speed, impact.second_speed) == pytest.approx((2.0, 1.0), abs=0.05)
    assert impact.closing_speed == pytest.approx(3.0, abs=0.1)


def test_robots_that_lean_on_each_other_have_no_impact():
    rig = WorldRig(load_profile("msl"))
    rig.place(cyan2=(-0.6, 0, 0), magenta2=(0, 0, 3.14159), ball=(3, 3, 0))
    for _ in range(300):
        assert rig.tick(cyan2=tell(vx=0.4), magenta2=tell(vx=0.0)).impacts == ()


def test_robots_that_pass_each_other_have_no_impact():
    rig = WorldRig(load_profile("msl"))
    rig.place(cyan2=(-3, 0, 0), magenta2=(0, 0.6, 0), ball=(3, 3, 0))
    assert all(rig.tick(cyan2=tell(vx=4.0)).impacts == () for _ in range(120))


def test_a_graze_counts_along_the_line_of_contact_only():
    rig = WorldRig(load_profile("msl"))
    rig.place(cyan2=(-3, 0, 0), magenta2=(0, 0.48, 0), ball=(3, 3, 0))
    (impact,) = impacts_of(rig, cyan2=tell(vx=3.0))
    assert impact.closing_speed < 1.5 < impact.first_velocity[0]


def test_a_robot_that_is_knocked_on_stood_when_it_was_hit():
    """Three in a row, the last two touching: the one in the middle hits the last by no speed of its own."""
    rig = WorldRig(load_profile("ideal"))
    gap = 2 * load_profile("ideal").robot.radius
    rig.place(cyan2=(-3, 0, 0), cyan1=(0, 0, 0), magenta2=(gap + 0.0005, 0, 0), ball=(3, 3, 0))
    (impact,) = impacts_of(rig, cyan2=tell(vx=3.0))
    assert [rig.roster.names[index] for index in (impact.first, impact.second)] == ["cyan1", "cyan2"]
    assert impact.first_speed == pytest.approx(0.0, abs=0.05)
    assert impact.second_speed == pytest.approx(3.0, rel=0.05)
