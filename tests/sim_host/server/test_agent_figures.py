"""What the host reports of its speed and of each agent, computed from few known events."""

from types import SimpleNamespace

import pytest

from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import ReceivedMessage
from schemas.bus.in_process_bus import InProcessBus, SharedState
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.messages.command import Command
from schemas.process.clock import SteppedClock
from schemas.topics import COMMAND
from sim_host.match.radio_use import RadioUse
from sim_host.server.account_limits import AccountLimits
from sim_host.server.agent_stats import AgentStats
from sim_host.server.health_reporter import HealthReporter
from sim_host.server.inbox import Inbox
from sim_host.server.invalid_log import InvalidLog
from sim_host.snapshot import Roster

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
    return reporter.report(tick, tick * 0.02, 0, NO_AGENTS, NO_RECORDERS, AccountLimits({}), RadioUse(), 2e6)


def test_the_real_time_factor_and_the_worst_tick_are_those_of_the_last_second():
    report = speed_after((10, 0.5), (150, 0.01))
    assert report.real_time_factor == pytest.approx(2.0)
    assert report.worst_tick_ms == pytest.approx(10.0)


def test_a_slow_tick_counts_for_a_second():
    report = speed_after((10, 0.01), (1, 0.3), (60, 0.01))
    assert report.worst_tick_ms == pytest.approx(300.0)
    assert report.real_time_factor < 1.6


class AnsweringBus(InProcessBus):
    """Its subscription has one command for each (tick, ns at which it arrived)."""

    def answers(self, *arrivals):
        self.left = [
            ReceivedMessage(COMMAND, "robot/cyan1/command", Command(answers_tick=tick).encode(), None, arrived_ns=at)
            for tick, at in arrivals
        ]

    def subscribe(self, topic, **_):
        return self

    def receive(self, timeout=0.0):
        return self.left.pop(0) if self.left else None


def test_the_latency_of_a_command_is_the_time_since_the_sight_that_it_answers():
    bus = AnsweringBus("friendly", SteppedClock(), SharedState())
    inbox = Inbox(
        bus, Roster.of(MatchConfig(), load_profile("msl")), InvalidLog(), BatchPublisher(bus), AccountLimits({})
    )
    bus.answers((1, 5_000_000), (2, 27_000_000), (3, 41_000_000))
    for tick, sent_ns in ((1, 1_000_000), (2, 21_000_000), (3, 40_000_000)):
        inbox.sights_sent(tick, sent_ns)
    while inbox.receive_command(3, 0.0):
        pass
    assert list(inbox.agent_stats["cyan1"].latencies) == pytest.approx([0.004, 0.006, 0.001])
    assert inbox.agent_stats["cyan1"].health(3).latency_ms == pytest.approx(4.0)


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
