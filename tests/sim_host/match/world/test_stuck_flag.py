"""The stuck flag: up where a robot makes no progress against its demands, however they flicker, and never else."""

import math
import random
from collections.abc import Callable, Iterator

import pytest

from schemas.config.profile import load_profile
from schemas.messages.applied import AppliedInput
from support.world_rig import REST, WorldRig
from support.world_rig import tell as drive


@pytest.fixture(params=["msl", pytest.param("ideal", marks=pytest.mark.long), "omni"])
def rig(request: pytest.FixtureRequest) -> Iterator[WorldRig]:
    rig = WorldRig(load_profile(request.param))
    yield rig
    rig.world.close()


def flags(rig: WorldRig, seconds: float, of: str, **inputs: Callable[[], AppliedInput]) -> list[bool]:
    """The flag of one robot in each tick, while these functions say what robots demand."""
    place, found = rig.roster.names.index(of), []
    for _ in range(round(seconds / rig.profile.time.tick)):
        rig.tick(**{name: demand() for name, demand in inputs.items()})
        found.append(rig.stuck[place])
    return found


def always(demand: AppliedInput) -> Callable[[], AppliedInput]:
    return lambda: demand


def flickering(seed: int, speed: float = 2.0) -> Callable[[], AppliedInput]:
    """As of a robot at a ball that it contests: ahead, now and then aside, backward or not at all."""
    dice = random.Random(seed)

    def demand() -> AppliedInput:
        if dice.random() < 0.15:
            return REST
        size, angle = speed * dice.uniform(0.5, 1.5), dice.uniform(-0.5, 0.5)
        if dice.random() < 0.1:
            size = -0.3 * size
        return drive(size * math.cos(angle), size * math.sin(angle), dice.uniform(-1.0, 1.0))

    return demand


@pytest.mark.parametrize("speed", [0.5, 2.0, 4.0])
def test_a_robot_that_drives_at_a_wall_is_stuck_within_a_second_and_until_it_turns_back(rig, speed):
    wall = rig.profile.field.goal_line + rig.profile.field.border - rig.profile.robot.radius
    rig.place(cyan1=(wall - 0.02, 3, 0))
    found = flags(rig, 2.0, "cyan1", cyan1=always(drive(speed)))
    assert not any(found[:5]) and all(found[50:])
    found = flags(rig, 2.5, "cyan1", cyan1=always(drive(-speed)))
    assert not any(found[100:]), "on wheels, the controller brakes what it had commanded first"


def test_a_robot_that_slides_along_a_wall_is_not_stuck(rig):
    """At 45 degrees half of its demanded progress is left, less friction."""
    wall = rig.profile.field.touch_line + rig.profile.field.border - rig.profile.robot.radius
    rig.place(cyan1=(-6, wall - 0.02, 0))
    assert not any(flags(rig, 2.0, "cyan1", cyan1=always(drive(1.5, 1.0))))


def test_a_wall_holds_a_robot_back_although_its_demands_flicker(rig):
    wall = rig.profile.field.goal_line + rig.profile.field.border - rig.profile.robot.radius
    rig.place(cyan1=(wall - 0.02, 3, 0))
    found = flags(rig, 4.0, "cyan1", cyan1=flickering(1))[50:]
    assert sum(found) / len(found) > 0.95


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in (1, 2))])
def test_flickering_demands_alone_make_no_robot_stuck(rig, seed):
    rig.place(cyan1=(-9, 0, 0), ball=(0, 5, 0))
    assert not any(flags(rig, 3.0, "cyan1", cyan1=flickering(seed)))


@pytest.mark.parametrize("demand", [drive(4), drive(0.3), drive(omega=8), drive(-2, 2, 3)])
def test_a_slow_start_and_a_stop_are_not_stuck(rig, demand):
    rig.place(cyan1=(-3, 0, 0.3), ball=(0, 5, 0))
    assert not any(flags(rig, 1.5, "cyan1", cyan1=always(demand)))
    assert not any(flags(rig, 1.5, "cyan1", cyan1=always(REST)))


def test_a_robot_that_stands_and_is_pushed_away_is_not_stuck(rig):
    r = rig.profile.robot.radius
    rig.place(cyan1=(-2 * r - 0.5, 0, 0), magenta1=(0, 0, 0), ball=(0, 5, 0))
    assert not any(flags(rig, 2.0, "magenta1", cyan1=always(drive(4)), magenta1=always(REST)))


def test_a_robot_that_pushes_one_that_stands_its_ground_is_stuck(rig):
    """Against a wall, so that it stands its ground with every drive."""
    r = rig.profile.robot.radius
    wall = rig.profile.field.goal_line + rig.profile.field.border
    rig.place(cyan1=(wall - 3 * r, 3, 0), magenta1=(wall - r, 3, 0))
    assert all(flags(rig, 2.0, "cyan1", cyan1=always(drive(2)), magenta1=always(REST))[60:])


def test_a_bump_is_not_stuck(rig):
    """Two robots that brush each other's hulls at 2 m/s and drive on."""
    r = rig.profile.robot.radius
    rig.place(cyan1=(-2, 0, 0), magenta1=(2, 1.8 * r, math.pi), ball=(0, 5, 0))
    found = [flags(rig, 0.02, "cyan1", cyan1=always(drive(2)), magenta1=always(drive(2)))[0] for _ in range(150)]
    assert not any(found)


def test_a_held_ball_makes_no_robot_stuck(rig):
    rig.give("cyan1", -9.0)
    demand = drive(1.5, dribble=True)
    assert not any(flags(rig, 3.0, "cyan1", cyan1=always(demand)))


def test_a_robot_that_is_placed_is_not_stuck_any_more(rig):
    wall = rig.profile.field.goal_line + rig.profile.field.border - rig.profile.robot.radius
    rig.place(cyan1=(wall - 0.02, 3, 0))
    assert flags(rig, 2.0, "cyan1", cyan1=always(drive(2)))[-1]
    rig.place(cyan1=(0, -3, 0))
    assert not any(flags(rig, 1.0, "cyan1", cyan1=always(drive(2))))
