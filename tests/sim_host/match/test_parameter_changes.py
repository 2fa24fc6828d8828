"""Live parameters have their effect from the next tick on, are recorded and published."""

import statistics
from collections.abc import Iterator
from typing import Any

import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive
from schemas.messages.parameters import ParameterOperation, ParametersReply, ParametersRequest
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight
from schemas.soccer.game import EventKind
from sim_host.match.simulation import Simulation, TickResult


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    simulation = Simulation(load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 1}))
    yield simulation
    simulation.close()


def set_to(simulation: Simulation, **values: Any) -> ParametersReply:
    given = {name.replace("__", "."): value for name, value in values.items()}
    return simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.SET, values=given))


def reset(simulation: Simulation) -> ParametersReply:
    return simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.RESET))


def drive(simulation: Simulation, seconds: float) -> TickResult:
    """cyan1 drives ahead as fast as it can; the last tick."""
    for _ in range(round(seconds / 0.02)):
        command = Command(answers_tick=simulation.now.tick, drive=Drive(vx=20.0), radio=Radio(role="x"))
        tick = simulation.step({"cyan1": command})
    return tick


def speed(simulation: Simulation, seconds: float) -> float:
    return float(drive(simulation, seconds).world["robots"]["cyan1"]["vx"])


def seen_balls(simulation: Simulation, ticks: int) -> list[float]:
    """x of the ball as cyan1 sees it, beside the truth."""
    errors = []
    for _ in range(ticks):
        tick = simulation.step({})
        ball = Sight.decode(tick.sights["cyan1"]).ball
        assert ball is not None
        errors.append(ball.x - tick.world["ball"]["x"])
    return errors


def test_a_speed_limit_bites_from_the_next_tick_on_and_reset_lifts_it(simulation: Simulation) -> None:
    assert set_to(simulation, drive__max_speed=1.0).accepted
    assert speed(simulation, 1.5) == approx(1.0, abs=1e-3)
    assert reset(simulation).accepted
    assert speed(simulation, 2.0) == approx(4.0, abs=1e-3)
    assert set_to(simulation, drive__max_speed=2.0).accepted
    assert speed(simulation, 1.0) == approx(2.0, abs=1e-3)


def test_what_robots_perceive_is_as_noisy_as_it_is_set(simulation: Simulation) -> None:
    """Standard deviations of 400 samples, within 20 % (the standard error is 3.5 %)."""
    set_to(simulation, noise__preset="perfect")
    assert max(map(abs, seen_balls(simulation, 5))) < 1e-3
    set_to(simulation, noise__preset="paper")
    assert statistics.pstdev(seen_balls(simulation, 400)) == approx(0.0194, rel=0.2)
    reset(simulation)
    assert simulation.live_parameters.preset == "profile"


def test_the_radio_falls_silent_when_every_word_is_lost(simulation: Simulation) -> None:
    assert Sight.decode(drive(simulation, 0.2).sights["cyan2"]).radio["cyan1"].age < 0.1
    set_to(simulation, radio__loss=1.0)
    last = drive(simulation, 0.5)
    heard = Sight.decode(last.sights["cyan2"]).radio
    assert "cyan1" not in heard or heard["cyan1"].age > 0.3


def test_a_change_is_recorded_with_the_inputs_of_its_tick_and_published_as_an_event(simulation: Simulation) -> None:
    simulation.step({})
    set_to(simulation, ball__mass=0.3, radio__loss=0.5)
    tick = simulation.step({})
    assert tick.applied["parameters"] == {"ball.mass": 0.3, "radio.loss": 0.5}
    assert tick.applied["checkpoint"]
    (event,) = [event for event in tick.events if event.kind is EventKind.PARAMETERS]
    assert event.tick == tick.tick and event.text == "operator sets ball.mass = 0.3, radio.loss = 0.5"
    assert "parameters" not in simulation.step({}).applied


def test_what_the_engine_does_not_need_makes_no_checkpoint(simulation: Simulation) -> None:
    simulation.step({})
    set_to(simulation, radio__loss=0.5, sensing__own_position=0.1)
    assert not simulation.step({}).applied["checkpoint"]


def test_a_refused_change_changes_nothing(simulation: Simulation) -> None:
    before = simulation.live_parameters
    reply = set_to(simulation, ball__mass=0.3, radio__loss=7.0)
    assert not reply.accepted and "radio.loss is 7.0" in reply.reason
    assert simulation.live_parameters == before
    tick = simulation.step({})
    assert "parameters" not in tick.applied
    assert [event for event in tick.events if event.kind is EventKind.PARAMETERS] == []
