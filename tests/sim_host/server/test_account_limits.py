"""Limits of accounts: what is counted, dropped and named, who is cut off, and who is admitted again."""

import pytest

from schemas.bus.contract import NoReplyError
from schemas.bus.refusals import Refusal
from schemas.messages.admission import AdmissionRequest
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.recorder import RecorderProgress
from schemas.messages.setup import SetupRequest
from schemas.recovery_window import RUN_AHEAD_TICKS
from schemas.side import Side
from schemas.topics import ADMISSION, COMMAND, ORDER, RECORDER_PROGRESS, SETUP
from sim_host.server.account_limits import CUT_OFF, MOST_EXTRA, MOST_PERIODS, OVER_RATE, AccountLimits

PERIOD_S = 0.25
SIDES = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta1": Side.MAGENTA}


def flood(rig, periods, key="cyan1", messages=2 * MOST_EXTRA):
    """Repeated commands of a robot in each of several periods, while the match goes on."""
    writer = rig.outside.publisher(COMMAND, robot=key)
    for _ in range(periods):
        for _ in range(messages):
            writer.put(Command(answers_tick=0))
        rig.ticks(1)
        rig.pass_time(PERIOD_S)
        rig.ticks(1)


def admit(rig, **words):
    pending = rig.outside.query(ADMISSION, AdmissionRequest(**words))
    rig.ticks(1)
    return pending.result(0.0)


@pytest.mark.parametrize(
    ("key", "account"),
    [
        ("robot/cyan2/command", "cyan"),
        ("robot/magenta1/command", "magenta"),
        ("robot/cyan1/manual", "operator"),
        ("team/cyan/order", "cyan_coach"),
        ("record/tape/progress", "recorder"),
    ],
)
def test_with_credentials_a_message_counts_for_the_account_that_alone_may_write_its_key(key, account):
    assert AccountLimits(SIDES, has_accounts=True).of_key(key).name == account
    assert AccountLimits(SIDES).of_key(key).name == key


def test_invented_keys_share_one_account_that_is_never_cut_off_and_known_keys_keep_their_own():
    limits = AccountLimits(SIDES)
    for number in range(1000):
        limits.of_key(f"robot/ghost{number}/command").accept(10, MOST_EXTRA)
        limits.of_key(f"record/r{number}/progress").accept(10, MOST_EXTRA)
        limits.add_refusals([Refusal(f"key{number}", "no key", 3, 30)])
    for _ in range(3 * MOST_PERIODS):
        limits.of_key("robot/ghost/command").accept(10, 10 * MOST_EXTRA)
        limits.end_period()
    assert len(limits.health()) < 30
    assert limits.cut_off == []
    assert limits.of_key("robot/cyan1/command").accept(10)


def test_an_agent_that_answers_each_sight_once_is_never_limited(rig):
    rig.ticks(3 * MOST_EXTRA)
    health = rig.health()
    account = health.accounts["robot/cyan1/command"]
    assert account.messages >= 3 * MOST_EXTRA
    assert account.size > account.messages
    assert account.dropped == {}
    assert all(robot.missed == 0 for robot in health.robots.values())


def test_what_is_over_the_limit_is_dropped_counted_and_not_recorded(rig):
    flood(rig, 1, messages=4 * MOST_EXTRA)
    account = rig.health().accounts["robot/cyan1/command"]
    assert account.dropped[OVER_RATE] > 2 * MOST_EXTRA
    assert not account.cut_off
    rig.ticks(10)
    health = rig.health()
    assert health.robots["cyan1"].answering  # the next period begins anew
    assert health.robots["cyan1"].duplicates <= MOST_EXTRA + 1


def test_who_goes_on_for_three_seconds_is_cut_off_and_its_robot_rests(rig):
    rig.ticks(20)
    flood(rig, MOST_PERIODS + 1)
    reports = [text for text in rig.silences() if "is cut off" in text]
    assert len(reports) == 1
    assert reports[0].startswith("robot/cyan1/command is cut off: ")
    rig.inputs("cyan1")
    rig.ticks(60)
    assert all(given.answers_tick is None for given in rig.inputs("cyan1"))
    assert abs(rig.truth("cyan1")["vx"]) < 0.01
    health = rig.health()
    assert health.accounts["robot/cyan1/command"].cut_off
    assert health.accounts["robot/cyan1/command"].dropped[CUT_OFF] > 50
    assert health.robots["cyan2"].answering and health.robots["cyan2"].missed == 0
    assert not health.accounts["robot/cyan2/command"].cut_off


def test_the_host_does_not_wait_for_a_robot_that_was_cut_off(rig):
    flood(rig, MOST_PERIODS + 1)
    before = rig.clock.now()
    rig.ticks(100)
    assert rig.clock.now() - before < 2.0


def test_with_credentials_the_whole_team_of_a_flooding_robot_is_cut_off_and_not_the_other(rig_of):
    rig = rig_of()
    rig.host.accounts.__init__(SIDES, has_accounts=True)
    rig.join_all()
    rig.begin()
    flood(rig, MOST_PERIODS + 1)
    rig.ticks(10)
    health = rig.health()
    assert health.accounts["cyan"].cut_off
    assert not health.accounts["magenta"].cut_off
    assert {name: robot.answering for name, robot in health.robots.items()} == {
        "cyan1": False,
        "cyan2": False,
        "magenta1": True,
    }


def test_a_forgiving_host_limits_and_never_cuts_off(rig_of):
    rig = rig_of(forgiving=True)
    rig.join_all()
    rig.begin()
    flood(rig, MOST_PERIODS + 5)
    rig.ticks(10)
    health = rig.health()
    assert not health.accounts["robot/cyan1/command"].cut_off
    assert health.accounts["robot/cyan1/command"].dropped[OVER_RATE] > 1000
    assert health.robots["cyan1"].answering


def test_who_was_cut_off_plays_again_when_a_referee_admits_it(rig):
    flood(rig, MOST_PERIODS + 1)
    reply = admit(rig, account="robot/cyan2/command")
    assert not reply.accepted
    assert reply.reason == "robot/cyan2/command is not cut off; cut off are: robot/cyan1/command"
    assert admit(rig).cut_off == ["robot/cyan1/command"]
    assert admit(rig, account="robot/cyan1/command", source="Ada").accepted
    assert "robot/cyan1/command is admitted again (Ada)" in rig.silences()
    rig.pass_time(PERIOD_S)
    rig.ticks(20)
    assert rig.health().robots["cyan1"].answering


def test_orders_in_a_flood_are_limited_and_the_other_sides_order_arrives(rig):
    writer = rig.outside.publisher(ORDER, side="cyan")
    for number in range(500):
        writer.put(CoachOrder(sequence=number + 1))
    rig.outside.publisher(ORDER, side="magenta").put(CoachOrder(sequence=1))
    rig.ticks(1)
    orders = rig.host.simulation.orders
    assert orders[Side.CYAN].sequence < 100
    assert orders[Side.MAGENTA].sequence == 1
    assert rig.health().accounts["team/cyan/order"].dropped[OVER_RATE] > 400


def test_a_flood_of_queries_is_answered_a_few_a_tick(rig):
    pending = [rig.outside.query(SETUP, SetupRequest()) for _ in range(200)]
    rig.ticks(1)

    def answered():
        count = 0
        for query in pending:
            try:
                count += bool(query.payload(0.0))
            except NoReplyError:
                continue
        return count

    assert 10 < answered() <= 64
    pending = pending[64:]
    rig.ticks(10)
    assert answered() <= 40


def test_a_recorder_that_nobody_admitted_is_served_and_not_waited_for(rig):
    stranger = rig.seat()
    stranger.declare_alive("recorder", "stranger")
    stranger.publisher(RECORDER_PROGRESS, name="stranger").put(RecorderProgress(tick=0, messages=0, lost=0))
    rig.ticks(2 * RUN_AHEAD_TICKS)
    assert rig.clock.now() < 5.0
    assert rig.health().recorders["stranger"] > RUN_AHEAD_TICKS


def test_thousands_of_recorders_that_never_report_do_not_hold_the_host(rig):
    stranger = rig.seat()
    for number in range(3000):
        stranger.declare_alive("recorder", f"x{number}")
    rig.ticks(2 * RUN_AHEAD_TICKS)
    assert rig.clock.now() < 5.0
    assert len(rig.health().recorders) <= 20
    rig.record()
    rig.ticks(1)
    assert "recorder" in rig.health().recorders


@pytest.mark.parametrize("by", ["operator", "match file"])
def test_a_recorder_that_an_operator_or_the_match_file_admits_is_waited_for(rig_of, by):
    rig = rig_of(record={"admit": ["tape"]} if by == "match file" else {})
    rig.join_all()
    rig.begin()
    tape = rig.seat()
    tape.declare_alive("recorder", "tape")
    if by == "operator":
        assert admit(rig, recorder="tape").accepted
        assert "the host waits for the recorder tape (operator)" in rig.silences()
    rig.ticks(RUN_AHEAD_TICKS + 20)
    assert rig.clock.now() > rig.config.patience.recorder
