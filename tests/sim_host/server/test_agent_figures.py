"""What the host reports of its speed and of each agent, computed from few known events."""

from types import SimpleNamespace

import pytest

from schemas.config.match_config import MatchConfig
from sim_host.match.radio_use import RadioUse
from sim_host.server.admission.agent_stats import AgentStats
from sim_host.server.admission.door import Admission
from sim_host.server.reports.health_reporter import HealthReporter
from support.stepped_clock import SteppedClock

NO_AGENTS = SimpleNamespace(agent_stats={}, unknown_senders={})
NO_RECORDERS = SimpleNamespace(recorder_lags=lambda tick: {})


def speed_after(*stretches):
    """The report at the end of stretches of (ticks, s of wall time each), ticks of 20 ms."""
    clock, tick = SteppedClock(), 0
    reporter = HealthReporter(clock, "lockstep")
    for ticks, took in stretches:
        for _ in range(ticks):
            clock.sleep_until(clock.now() + took)
            tick += 1
            reporter.end_tick(tick * 0.02)
    return reporter.report(tick, tick * 0.02, 0, NO_AGENTS, NO_RECORDERS, Admission(MatchConfig(), {}), RadioUse(), 2e6)


def test_the_real_time_factor_and_the_worst_tick_are_those_of_the_last_second():
    report = speed_after((10, 0.5), (150, 0.01))
    assert report.real_time_factor == pytest.approx(2.0)
    assert report.worst_tick_ms == pytest.approx(10.0)


def test_a_slow_tick_counts_for_a_second():
    report = speed_after((10, 0.01), (1, 0.3), (60, 0.01))
    assert report.worst_tick_ms == pytest.approx(300.0)
    assert report.real_time_factor < 1.6


def test_an_agent_that_was_given_up_and_answers_late_is_waited_for_one_tick_more():
    stats = AgentStats(alive=True)
    for _ in range(3):
        assert not stats.is_silent
        stats.end_tick(answered=False)
    assert stats.is_silent
    stats.add_answer(1, 4)
    assert not stats.is_silent
    stats.end_tick(answered=False)
    assert stats.is_silent
    stats.add_answer(2, 5)
    assert stats.is_silent, "the next chance comes only after as many missed ticks again"
    for _ in range(2):
        stats.end_tick(answered=False)
    stats.add_answer(3, 7)
    assert not stats.is_silent
