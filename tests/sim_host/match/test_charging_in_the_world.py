"""Charging and pushing with the real engine: who is called when robots run into each other."""

import pytest

from schemas.config.profile import load_profile
from schemas.config.scene import SceneGame
from schemas.config.soccer.rule_book import load_rule_book
from schemas.frames import Pose
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from sim_host.soccer.referee.core import Referee
from support.world_rig import WorldRig, tell

PHASES = [0.0, 0.013, 0.031, 0.047]
"""m; where a robot begins, so that it arrives at all moments of a tick."""


def called(rig, ticks=200, **inputs):
    """The first fouls that the referee calls while the robots drive, each with the measured quantity."""
    profile, roster = rig.profile, rig.roster
    starts = {name: Pose(0.0, 0.0, 0.0) for name in roster.names}
    referee = Referee(
        load_rule_book("msl"),
        profile.field,
        profile.ball,
        roster,
        duration=None,
        kick_off=Side.CYAN,
        automatic=True,
        starts=starts,
    )
    ball = rig.world.snapshot().ball
    state = referee.begin_at(SceneGame(phase=Phase.PLAY), (ball.x, ball.y))
    for _ in range(ticks):
        ruling = referee.step(state, rig.tick(**inputs), (), profile.time.tick)
        state = ruling.state
        fouls = [(event.rule, event.robot, event.measured) for event in ruling.events if event.kind is EventKind.FOUL]
        if fouls:
            return fouls
    return []


@pytest.mark.parametrize("profile", ["msl", "ideal", "omni"])
@pytest.mark.parametrize("phase", PHASES)
def test_a_robot_at_full_speed_into_a_standing_opponent_charges_it(profile, phase):
    rig = WorldRig(load_profile(profile))
    rig.place(cyan2=(-3.0 + phase, 0, 0), magenta2=(0, 0, 0), ball=(5, 0, 0))
    ((rule, robot, speed),) = called(rig, cyan2=tell(vx=4.0))
    assert (rule, robot) == ("charging", "cyan2") and speed == pytest.approx(3.5, abs=0.2)


@pytest.mark.parametrize("lateral", [0.0, 0.1, 0.2, 0.3, 0.4])
def test_a_charge_is_called_wherever_in_a_physics_step_the_robots_meet(lateral):
    rig, missed = WorldRig(load_profile("msl")), []
    for number in range(20):
        start = -3.0 - 0.021 * number
        rig.place(cyan2=(start, lateral, 0), magenta2=(0, 0, 0), ball=(5, 5, 0))
        if [(rule, robot) for rule, robot, _ in called(rig, cyan2=tell(vx=4.0))] != [("charging", "cyan2")]:
            missed.append(start)
    assert missed == []


@pytest.mark.parametrize("gap", [0.505, 0.55, 0.7])
def test_a_robot_that_knocks_its_teammate_into_an_opponent_is_called_in_its_place(gap):
    rig = WorldRig(load_profile("msl"))
    rig.place(cyan2=(-3, 0, 0), cyan1=(0, 0, 0), magenta2=(gap, 0, 0), ball=(0, 5, 0))
    ((rule, robot, _),) = called(rig, cyan2=tell(vx=4.0))
    assert (rule, robot) == ("charging", "cyan2")


@pytest.mark.parametrize("speed", [1.2, 1.5, 2.0, 3.0])
def test_a_robot_that_pushes_with_the_ball_in_its_dribbler_is_called(speed):
    rig = WorldRig(load_profile("msl"))
    rig.place(cyan2=(-1.5, 0, 0), magenta2=(0, 0, 0), ball=(-1.14, 0, 0))
    ((rule, robot, way),) = called(rig, cyan2=tell(vx=speed, dribble=True))
    assert (rule, robot, way) == ("pushing", "cyan2", pytest.approx(0.5, abs=0.02))
    assert rig.at("magenta2").x < 0.7
