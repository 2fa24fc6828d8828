"""A robot whose commands stop arriving comes to rest: when, from which speed."""

import math
from dataclasses import replace

import pytest

from schemas.config.profile import Profile, load_profile
from schemas.messages.command import Command, Drive
from sim_host.actuation.latest_commands import CommandLimits, LatestCommands
from support.world_rig import WorldRig

SPEEDS = {0.6: 0.16, 1.0: 0.24, 1.2: 0.28, 4.0: 0.84}
"""Speed in m/s → longest time until rest, in s: 0.06 s until it brakes, and braking at 5 m/s²."""


def time_to_rest(profile: Profile, speed: float) -> float:
    """Simulated time from the last command's tick until a robot that drives at this speed is at rest, in s."""
    rig = WorldRig(profile)
    rig.place(cyan1=(-8.0, 0.0, 0.0), ball=(0.0, 5.0, 0.0))
    commands = LatestCommands(rig.roster.names, CommandLimits.of(profile.safety, profile.time.tick))
    driving = Drive(vx=speed)
    lasts = round((speed / profile.drive.acceleration + 0.3) / profile.time.tick)
    for tick in range(lasts + 100):
        fresh = {"cyan1": Command(answers_tick=tick, drive=driving)} if tick <= lasts else {}
        rig.world.advance(commands.inputs(tick, fresh))
        robot = rig.engine.robot_twist(rig.roster.names.index("cyan1"))
        if tick == lasts:
            assert math.hypot(robot[0], robot[1]) == pytest.approx(speed, rel=0.02)
        if tick > lasts and math.hypot(robot[0], robot[1]) < 0.01:
            return (tick - lasts) * profile.time.tick
    raise AssertionError("it never rests")


@pytest.mark.parametrize("speed", SPEEDS)
def test_a_robot_that_is_cut_off_rests_after_what_its_grip_takes(speed: float) -> None:
    profile = load_profile("msl")
    rest = time_to_rest(profile, speed)
    assert rest <= SPEEDS[speed] + 1e-9
    watchdog_alone = replace(profile, safety=replace(profile.safety, silence=10.0))
    assert time_to_rest(watchdog_alone, speed) - rest == pytest.approx(
        profile.safety.watchdog - profile.safety.silence + profile.time.tick, abs=0.03
    )
