"""Real time and its multiples: ticks are due by the clock, and nobody is waited for."""

import pytest

from schemas.command import Command, Drive
from schemas.host import AppliedInput
from schemas.topics import COMMAND, HEALTH

REST = AppliedInput(drive=Drive(), dribble=False)
WATCHDOG_TICKS = 10
"""0.2 s of simulated time."""


@pytest.mark.parametrize(("pace", "period"), [("realtime", 0.02), ("x4", 0.005), ("x0.5", 0.04)])
def test_ticks_are_due_at_the_pace(pitch_of, pace, period):
    pitch = pitch_of(pace=pace)
    reports = pitch.hear(HEALTH)
    pitch.join_all()
    pitch.begin()
    moments = []
    for _ in range(200):
        pitch.ticks(1)
        moments.append(pitch.clock.now())
    assert moments == pytest.approx([period * (number + 1) for number in range(200)])
    last = reports.all()[-1]
    assert (last.pace, last.late_ticks) == (pace, 0)
    assert last.real_time_factor == pytest.approx(0.02 / period, rel=0.05)


def test_late_ticks_are_counted_told_and_not_made_up_for(live, monkeypatch):
    step = live.host.simulation.step
    took = {5: 0.05, 6: 0.03, 20: 0.019}

    def slow_step(*words):
        live.pass_time(took.get(live.host.simulation.now.tick, 0.0))
        return step(*words)

    monkeypatch.setattr(live.host.simulation, "step", slow_step)
    live.ticks(30)
    late = (0.05 - 0.02) + (0.03 - 0.02)
    assert live.clock.now() == pytest.approx(30 * 0.02 + late)
    health = live.health()
    assert health.late_ticks == 2 + 1
    assert health.worst_tick_ms > 50


def test_a_silent_robot_is_braked_by_the_watchdog_and_comes_back(live):
    live.ticks(50)
    live.agents["cyan2"].frozen = True
    began = live.clock.now()
    live.ticks(100)
    assert live.clock.now() - began == pytest.approx(2.0)
    inputs = live.inputs("cyan2")
    assert all(given.drive == Drive(vx=1.0) for given in inputs[: 50 + WATCHDOG_TICKS])
    assert inputs[50 + WATCHDOG_TICKS :] == [REST] * (100 - WATCHDOG_TICKS)
    assert abs(live.truth("cyan2")["vx"]) < 1e-3
    assert live.truth("cyan1")["vx"] > 0.5
    health = live.health().robots["cyan2"]
    assert (health.alive, health.answering, health.missed) == (True, False, 101)
    live.agents["cyan2"].frozen = False
    live.ticks(30)
    assert live.truth("cyan2")["vx"] > 0.1
    assert live.silences() == ["cyan2 does not answer, its robot rests", "cyan2 answers"]


def test_a_robot_that_misses_less_than_the_watchdog_allows_is_not_called_silent(live):
    live.ticks(20)
    live.agents["cyan2"].frozen = True
    live.ticks(WATCHDOG_TICKS - 1)
    assert live.silences() == []
    live.ticks(1)
    assert live.silences() == ["cyan2 does not answer, its robot rests"]


def test_the_newest_of_two_commands_counts(live):
    live.ticks(3)
    live.agents["cyan1"].frozen = True
    writer = live.outside.publisher(COMMAND, robot="cyan1")
    writer.put(Command(answers_tick=2, drive=Drive(vy=0.1)))
    writer.put(Command(answers_tick=3, drive=Drive(vy=0.3)))
    live.ticks(1)
    assert live.inputs("cyan1")[-1].drive == Drive(vy=0.3)


def test_a_burst_of_stale_commands_moves_nobody(live):
    live.agents["cyan1"].frozen = True
    live.ticks(40)
    writer = live.outside.publisher(COMMAND, robot="cyan1")
    for tick in range(40 - WATCHDOG_TICKS):
        writer.put(Command(answers_tick=tick, drive=Drive(vx=3.0)))
    live.ticks(3)
    assert live.inputs("cyan1")[-3:] == [REST] * 3
