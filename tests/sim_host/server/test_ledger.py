"""The ledger that the host keeps of each robot: sights, answers in time and late, losses, latencies, radio."""

import pytest

from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.messages.command import Command
from schemas.messages.latency_counts import CLASSES, class_of, quantile_ms
from schemas.messages.radio import Radio
from schemas.side import Side
from schemas.topics import COMMAND, HEALTH
from sim_host.match.radio_medium import Budget
from sim_host.match.radio_use import RadioUse
from sim_host.server.admission.agent_stats import AgentStats
from sim_host.server.admission.door import Admission
from sim_host.server.inbox import Inbox
from sim_host.snapshot import Roster
from support.in_process_bus import InProcessBus, SharedState
from support.stepped_clock import SteppedClock


class Talker:
    """Sends a radio message with every command."""

    def __init__(self, intention: str = "") -> None:
        self.radio = Radio(role="striker", intention=intention)

    def act(self, sight):
        return Command(answers_tick=sight.tick, radio=self.radio)


class StampedBus(InProcessBus):
    """Its subscription has one command of cyan1 for each (sequence number, answered tick)."""

    def __init__(self):
        super().__init__("friendly", SteppedClock(), SharedState())
        self.left = []

    def arrive(self, *commands):
        self.left += [
            ReceivedMessage(COMMAND, "robot/cyan1/command", payload, stamp, 0)
            for sequence, tick in commands
            for stamp in [Stamp(sequence, 0, 0) if sequence is not None else None]
            for payload in [Command(answers_tick=tick).encode() if tick is not None else b"{}"]
        ]

    def subscribe(self, topic, **_):
        return self

    def receive(self, timeout=0.0):
        return self.left.pop(0) if self.left else None


def arrival(tick, arrived_ns):
    """A command of cyan1 that answers this tick."""
    return ReceivedMessage(COMMAND, "robot/cyan1/command", Command(answers_tick=tick).encode(), None, arrived_ns)


@pytest.fixture
def bus():
    return StampedBus()


@pytest.fixture
def inbox(bus):
    inbox = Inbox(bus, Roster.of(MatchConfig(), load_profile("msl")), BatchPublisher(bus), Admission(MatchConfig(), {}))
    inbox.agent_stats["cyan1"].alive = True
    return inbox


def receive_all(inbox, tick):
    while inbox.receive_command(tick, 0.0):
        pass
    return inbox.agent_stats["cyan1"].health(tick)


@pytest.mark.parametrize(
    ("commands", "lost"),
    [
        (((0, 1), (1, 2), (4, 5), (5, None), (7, 8)), 2 + 1),
        (((700, 1), (701, 2), (0, 3), (1, 4)), 0),
        (((None, 1), (50, 2), (None, 3), (51, 4), (53, 5)), 1),
        (((0, 1), (1, 2), (2, 3), (0, 1), (1, 2), (3, 4), (0, 1), (4, 5)), 0),
        (((5000, 1), (3, 2), (5001, 3), (4, 4), (5002, 5)), 0),
    ],
    ids=["gaps", "a first number and a restart", "none before the first", "repeated commands", "a second writer"],
)
def test_commands_that_are_missing_in_the_numbers_of_an_agent_are_counted_as_lost(bus, inbox, commands, lost):
    bus.arrive(*commands)
    assert receive_all(inbox, max(tick or 0 for _, tick in commands)).lost_commands == lost


def test_commands_that_are_lost_in_a_long_cut_are_counted():
    stats = AgentStats(alive=True)
    stats.add_answer(10, 10)
    stats.next_sequence = 11
    stats.add_gap(4010, 4010)
    assert stats.lost_commands == 3999


def test_in_real_time_answers_on_time_and_late_ones_double_and_missing_ones_are_told_apart(realtime_rig):
    rig = realtime_rig
    rig.ticks(10)
    rig.agents["cyan2"].thinks_s = 0.03
    rig.ticks(10)
    runner = rig.agents["cyan1"].runner
    sight = runner.next_sight(0.0)
    runner.answer(sight)
    runner.answer(sight)
    rig.agents["magenta1"].frozen = True
    rig.ticks(5)
    robots = rig.health().robots
    assert robots["cyan1"].duplicates == 1
    assert (robots["cyan1"].late, robots["cyan1"].missed) == (0, 0)
    assert robots["cyan2"].late == robots["cyan2"].answers - 10 > 0
    assert robots["cyan2"].missed > 0
    assert robots["magenta1"].missed == 5 + 1
    assert robots["magenta1"].sights == robots["magenta1"].answers + 6


def test_in_lockstep_every_sight_is_answered_on_time(rig):
    rig.ticks(30)
    for robot in rig.health().robots.values():
        assert (robot.sights, robot.answers, robot.late, robot.lost_commands) == (31, 31, 0, 0)


def test_a_silent_robot_has_the_ticks_that_it_has_missed_since_it_answered(realtime_rig):
    realtime_rig.agents["cyan2"].frozen = True
    realtime_rig.ticks(5)
    assert realtime_rig.health().robots["cyan2"].missed_in_a_row == 6
    realtime_rig.agents["cyan2"].frozen = False
    cyan2 = realtime_rig.health().robots["cyan2"]
    assert (cyan2.missed_in_a_row, cyan2.missed) == (0, 6)


def test_no_sights_are_counted_while_no_agent_is_present(rig):
    rig.ticks(10)
    rig.leave("cyan2")
    rig.ticks(10)
    assert rig.health().robots["cyan2"].sights == 10


def test_sights_that_an_agent_misses_are_unanswered(realtime_rig):
    rig = realtime_rig
    rig.medium.lose("robot/cyan1/sight", {3, 7, 8})
    rig.ticks(20)
    robots = rig.health().robots
    assert (robots["cyan1"].unanswered, robots["cyan1"].lost_commands) == (3, 0)
    assert robots["cyan2"].unanswered == 0


def test_the_latency_of_a_command_is_the_time_since_the_sight_that_it_answers(inbox, bus):
    for tick, sent_ns, arrived_ns in (
        (1, 1_000_000, 5_000_000),
        (2, 21_000_000, 27_000_000),
        (3, 40_000_000, 41_000_000),
    ):
        inbox.sights_sent(tick, sent_ns)
        bus.left.append(arrival(tick, arrived_ns))
    assert receive_all(inbox, 3).latency_ms == pytest.approx(4.0)
    assert list(inbox.agent_stats["cyan1"].latencies) == pytest.approx([0.004, 0.006, 0.001])


def test_the_latency_of_an_answer_after_seconds_is_counted(inbox, bus):
    for tick in range(1, 102):
        inbox.sights_sent(tick, tick * 20_000_000)
    bus.left.append(arrival(1, 2_020_000_000))
    assert quantile_ms(receive_all(inbox, 101).latencies, 0.5) == pytest.approx(2000, rel=0.2)


@pytest.mark.parametrize("latency_ms", [0.13, 1.0, 7.3, 42.0, 250.0, 3900.0])
def test_a_quantile_is_exact_within_a_fifth(latency_ms):
    counts = [0] * CLASSES
    counts[class_of(latency_ms * 1e-3)] = 100
    assert quantile_ms(counts, 0.5) == pytest.approx(latency_ms, rel=0.2)


def test_the_shortest_and_the_longest_latencies_have_a_class():
    assert class_of(0.0) == class_of(-1.0) == 0
    assert class_of(3600.0) == CLASSES - 1
    assert quantile_ms([*[0] * (CLASSES - 1), 1], 0.5) == pytest.approx(4096, rel=0.2)
    assert quantile_ms([], 0.5) is None


def test_quantiles_are_ordered_and_divide_the_answers():
    counts = [0] * CLASSES
    for latency_ms in range(1, 101):
        counts[class_of(latency_ms * 1e-3)] += 1
    assert quantile_ms(counts, 0.5) == pytest.approx(50, rel=0.1)
    assert quantile_ms(counts, 0.99) == pytest.approx(99, rel=0.1)


def test_bytes_on_the_radio_are_counted_for_each_robot_and_against_the_budget_of_its_team(rig_of):
    rig = rig_of()
    rig.join("cyan1", Talker("get the ball"))
    rig.join("cyan2", Talker())
    rig.join("magenta1")
    rig.begin()
    rig.ticks(100)
    health = rig.health()
    cyan1, cyan2, magenta1 = (health.robots[name] for name in ("cyan1", "cyan2", "magenta1"))
    assert cyan1.radio_bytes > cyan2.radio_bytes > 0 == magenta1.radio_bytes
    sent = 8 * (cyan1.radio_bytes + cyan2.radio_bytes)
    team = health.radio[Side.CYAN]
    assert team.busiest == pytest.approx(sent / 2, rel=0.05), "101 ticks are two seconds"
    assert team.budget == rig.host.simulation.profile.radio.budget
    assert health.radio[Side.MAGENTA].busiest == 0


def test_messages_beyond_the_budget_are_counted_as_refused(rig_of):
    rig = rig_of(radio={"budget": 5000})
    rig.join("cyan1", Talker("x" * 60))
    rig.join("cyan2")
    rig.join("magenta1")
    rig.begin()
    rig.ticks(50)
    health = rig.health()
    assert health.robots["cyan1"].radio_refused > 30
    assert 4000 < health.radio[Side.CYAN].busiest <= 5000


def test_the_busiest_second_of_a_team_outlasts_an_episode():
    use, first, second = RadioUse(), {side: Budget() for side in Side}, {side: Budget() for side in Side}
    use.follow(first)
    first[Side.CYAN].spend(0.0, 800)
    use.follow(second)
    second[Side.CYAN].spend(0.0, 300)
    second[Side.MAGENTA].spend(0.0, 200)
    assert (use.busiest(Side.CYAN), use.busiest(Side.MAGENTA)) == (800, 200)


def test_the_last_report_of_a_match_has_the_counts_of_its_last_tick(rig):
    rig.ticks(7)
    listener = rig.listen(HEALTH)
    rig.host.wait_for_recorders()
    report = listener.all()[-1]
    assert report.tick == 7
    assert report.robots["cyan1"].answers == 7
