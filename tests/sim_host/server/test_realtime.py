"""Real time and its multiples: ticks are due by the clock, and the host waits for no agent."""

import pytest

from schemas.messages.applied import AppliedInput
from schemas.messages.command import Command, Drive
from schemas.topics import COMMAND, HEALTH

REST = AppliedInput(drive=Drive(), dribble=False)
WATCHDOG_TICKS = 10
"""0.2 s of simulated time."""


@pytest.mark.parametrize(("pace", "period"), [("realtime", 0.02), ("x4", 0.005), ("x0.5", 0.04)])
def test_ticks_are_due_at_the_pace(rig_of, pace, period):
    rig = rig_of(pace=pace)
    reports = rig.listen(HEALTH)
    rig.join_all()
    rig.begin()
    moments = []
    for _ in range(200):
        rig.ticks(1)
        moments.append(rig.clock.now())
    assert moments == pytest.approx([period * (number + 1) for number in range(200)])
    last = reports.all()[-1]
    assert (last.pace, last.late_ticks) == (pace, 0)
    assert last.real_time_factor == pytest.approx(0.02 / period, rel=0.05)


def test_late_ticks_are_counted_and_published_and_not_made_up_for(realtime_rig, monkeypatch):
    reports = realtime_rig.listen(HEALTH)
    step = realtime_rig.host.simulation.step
    took = {5: 0.05, 6: 0.03, 20: 0.019}

    def slow_step(*words):
        realtime_rig.pass_time(took.get(realtime_rig.host.simulation.now.tick, 0.0))
        return step(*words)

    monkeypatch.setattr(realtime_rig.host.simulation, "step", slow_step)
    realtime_rig.ticks(30)
    late = (0.05 - 0.02) + (0.03 - 0.02)
    assert realtime_rig.clock.now() == pytest.approx(30 * 0.02 + late)
    newest = reports.all()[-1]
    assert newest.late_ticks == 2
    assert newest.worst_tick_ms == pytest.approx(70)  # one period of sleep, and 50 ms of work


def test_a_robot_that_misses_less_than_the_watchdog_allows_is_not_called_silent(realtime_rig):
    realtime_rig.ticks(20)
    realtime_rig.agents["cyan2"].frozen = True
    realtime_rig.ticks(WATCHDOG_TICKS - 1)
    assert realtime_rig.silences() == []
    realtime_rig.ticks(1)
    assert realtime_rig.silences() == ["cyan2 does not answer, its robot stops"]


def test_the_newest_of_two_commands_counts(realtime_rig):
    realtime_rig.ticks(3)
    realtime_rig.agents["cyan1"].frozen = True
    writer = realtime_rig.outside.publisher(COMMAND, robot="cyan1")
    writer.put(Command(answers_tick=2, drive=Drive(vy=0.1)))
    writer.put(Command(answers_tick=3, drive=Drive(vy=0.3)))
    realtime_rig.ticks(1)
    assert realtime_rig.inputs("cyan1")[-1].drive == Drive(vy=0.3)


def test_a_burst_of_stale_commands_moves_no_robot(realtime_rig):
    realtime_rig.agents["cyan1"].frozen = True
    realtime_rig.ticks(40)
    writer = realtime_rig.outside.publisher(COMMAND, robot="cyan1")
    for tick in range(40 - WATCHDOG_TICKS):
        writer.put(Command(answers_tick=tick, drive=Drive(vx=3.0)))
    realtime_rig.ticks(3)
    assert realtime_rig.inputs("cyan1")[-3:] == [REST] * 3
