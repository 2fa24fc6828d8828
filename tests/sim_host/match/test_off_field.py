"""Robots off the field in a simulation: beside it, at rest, with the reason in their sights, and back in time."""

from collections.abc import Iterator
from typing import Any

import pytest

from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.messages.world import World
from schemas.soccer.game import ActionName, OffField
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation, TickResult


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    names = {"duration": 60.0, "noise.preset": "perfect", "rules": "msl"}
    simulation = Simulation(load_match(None, names))
    yield simulation
    simulation.close()


def step(simulation: Simulation, *actions: RefereeAction, silent: tuple[str, ...] = ()) -> TickResult:
    """All robots with a program drive ahead."""
    tick = simulation.now.tick
    told = {
        name: Command(answers_tick=tick, drive=Drive(vx=0.5), radio=Radio(role="any"))
        for name in simulation.roster.names
        if name not in silent
    }
    return simulation.step(told, actions, silent=silent)


def ask(name: str, robot: str) -> RefereeAction:
    return RefereeAction(action=ActionName(name), robot=robot)


def truth(tick: TickResult) -> World:
    fields: dict[str, Any] = {**tick.world, "version": "2.0"}
    return validated(World, fields)


def run(simulation: Simulation, seconds: float, silent: tuple[str, ...] = ()) -> TickResult:
    for _ in range(round(seconds / simulation.profile.time.tick)):
        step(simulation, silent=silent)
    return simulation.now


@pytest.mark.parametrize("robot", ["cyan1", "magenta4"])
def test_a_robot_that_is_sent_off_stands_beside_the_field_and_its_commands_rest(
    simulation: Simulation, robot: str
) -> None:
    run(simulation, 1.0)
    step(simulation, ask("red_card", robot))
    before = truth(run(simulation, 0.1)).robots[robot]
    after = truth(run(simulation, 1.0)).robots[robot]
    field = simulation.profile.field
    assert after.off_field is OffField.RED_CARD and abs(after.y) > field.touch_line + field.border
    assert (after.x, after.y) == pytest.approx((before.x, before.y), abs=1e-6)
    assert simulation.now.applied["inputs"][robot].drive == Drive()
    others = [name for name in simulation.roster.names if name != robot]
    assert all(truth(simulation.now).robots[name].off_field is None for name in others)


def test_its_team_receives_the_reason_and_the_duration_and_the_other_team_does_not(simulation: Simulation) -> None:
    run(simulation, 0.5)
    step(simulation, ask("repair", "cyan3"))
    run(simulation, 5.0)
    mine = Sight.decode(simulation.now.sights["cyan3"]).game
    assert mine.robots["cyan3"].off_field is OffField.REPAIR
    assert mine.robots["cyan3"].left == pytest.approx(15.0, abs=0.05)
    assert Sight.decode(simulation.now.sights["magenta1"]).game.robots == {}


def test_who_is_off_comes_back_and_is_obeyed_again(simulation: Simulation) -> None:
    run(simulation, 0.5)
    step(simulation, ask("park", "cyan3"))
    run(simulation, 0.5)
    step(simulation, ask("enter", "cyan3"))
    there = truth(run(simulation, 0.1)).robots["cyan3"]
    gone = truth(run(simulation, 0.5)).robots["cyan3"]
    assert there.off_field is None and abs(there.y) < simulation.profile.field.touch_line
    assert abs(gone.x - there.x) + abs(gone.y - there.y) > 0.1


def test_seconds_to_a_limit_are_in_every_sight(simulation: Simulation) -> None:
    """From the signal of the kick-off to START."""
    run(simulation, 1.5)
    pause = simulation.config.load_rule_book().restarts.signal_to_start
    assert Sight.decode(simulation.now.sights["cyan2"]).game.left == pytest.approx(pause - 1.5, abs=0.05)
