"""Limits of accounts: what is counted, dropped and named, and which side forfeits."""

import pytest

from runtime.bus.contract import NoReplyError
from runtime.bus.refusals import Refusal
from schemas.messages.admission import AdmissionRequest
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.recorder import RecorderProgress
from schemas.messages.setup import SetupRequest
from schemas.recovery_window import RUN_AHEAD_TICKS
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from schemas.topics import ADMISSION, COMMAND, EVENT, ORDER, RECORDER_PROGRESS, SETUP
from sim_host.server.admission import account_limits
from sim_host.server.admission.account_limits import EXTRA_RATE, MOST_EXTRA, OVER_LIMIT, AccountLimits

SIDES = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta1": Side.MAGENTA}


def flood(rig, robot="cyan1", messages=2 * MOST_EXTRA):
    """Repeated commands of a robot, while the match goes on."""
    writer = rig.outside.publisher(COMMAND, robot=robot)
    for _ in range(messages // 1000):
        for _ in range(1000):
            writer.put(Command(answers_tick=0))
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
    for has_accounts, name in ((True, account), (False, key)):
        limits = AccountLimits(SIDES, has_accounts=has_accounts)
        limits.of_key(key).accept(10)
        assert list(limits.health()) == [name]


def test_invented_keys_share_one_account_and_known_keys_keep_their_own():
    limits = AccountLimits(SIDES)
    for number in range(1000):
        limits.of_key(f"robot/ghost{number}/command").accept(10, MOST_EXTRA)
        limits.of_key(f"record/r{number}/progress").accept(10, MOST_EXTRA)
        limits.add_refusals([Refusal(f"key{number}", "no key", 3, 30)])
    assert len(limits.health()) < 30
    assert not limits.of_key("robot/ghost/command").accept(10, 1)
    assert limits.of_key("robot/cyan1/command").accept(10)


def test_an_account_may_send_as_many_useless_messages_as_time_allows():
    account = (limits := AccountLimits(SIDES)).of_key("robot/cyan1/command")
    assert account.accept(1, MOST_EXTRA)
    assert not account.accept(1, 1)
    limits.pass_time(1.0)
    assert account.accept(1, int(EXTRA_RATE))
    assert not account.accept(1, 1)
    assert account.dropped == {OVER_LIMIT: 2}


def test_an_agent_that_answers_each_sight_once_is_never_limited(rig, monkeypatch):
    monkeypatch.setattr(account_limits, "MOST_EXTRA", 300)
    rig.ticks(310)
    health = rig.health()
    account = health.accounts["robot/cyan1/command"]
    assert account.messages >= 300
    assert account.size > account.messages
    assert account.dropped == {}
    assert all(robot.missed == 0 for robot in health.robots.values())


def test_what_is_over_the_limit_is_dropped_counted_named_once_and_not_recorded(rig):
    flood(rig)
    account = rig.health().accounts["robot/cyan1/command"]
    assert account.dropped[OVER_LIMIT] > MOST_EXTRA / 2
    assert rig.health().robots["cyan1"].duplicates <= MOST_EXTRA + 1
    over = "robot/cyan1/command is over its limit of messages: the rest is not read"
    assert [text for text in rig.silences() if "over its limit" in text] == [over]
    rig.pass_time(1.0)
    rig.ticks(10)
    assert rig.health().robots["cyan1"].answering  # time has allowed it more


def test_the_host_does_not_wait_for_a_robot_over_its_limit_and_the_others_play_on(rig):
    flood(rig)
    before = rig.clock.now()
    flood(rig)
    assert rig.clock.now() - before < 2.0
    health = rig.health()
    assert health.robots["cyan2"].answering and health.robots["cyan2"].missed == 0


def test_without_credentials_nobody_forfeits_since_anybody_may_have_flooded(rig):
    flood(rig, messages=4 * MOST_EXTRA)
    assert not rig.host.simulation.over


def flooded_by(rig, *robots):
    """The events of a match with accounts that these robots flood."""
    rig.host.accounts.__init__(SIDES, has_accounts=True)
    rig.join_all()
    rig.begin()
    events = rig.listen(EVENT)
    for _ in range(5):
        for writer in [rig.outside.publisher(COMMAND, robot=robot) for robot in robots]:
            for _ in range(1000):
                writer.put(Command(answers_tick=0))
        if not rig.host.simulation.over:
            rig.ticks(1)
    assert rig.host.simulation.state.phase is Phase.FULL_TIME
    return events


def test_where_robots_of_both_sides_flood_neither_side_wins(rig):
    assert EventKind.FORFEIT not in [event.kind for event in flooded_by(rig, "cyan2", "magenta1").all()]


@pytest.mark.parametrize(("loser", "robot"), [("cyan", "cyan2"), ("magenta", "magenta1")])
def test_with_credentials_the_side_of_a_flooding_robot_forfeits(rig, loser, robot):
    events = flooded_by(rig, robot)
    (forfeit,) = [event for event in events.all() if event.kind is EventKind.FORFEIT]
    assert (forfeit.side, forfeit.text) == (Side(loser), f"{loser} forfeits: by decision of host")
    assert forfeit.score.of(Side(loser)) == 0 < forfeit.score.of(Side(loser).opponent)
    assert rig.health().accounts[loser].dropped[OVER_LIMIT] > 0


def test_orders_in_a_flood_are_limited_and_the_other_sides_order_arrives(rig):
    writer = rig.outside.publisher(ORDER, side="cyan")
    for number in range(2000):
        writer.put(CoachOrder(sequence=number + 1))
    rig.outside.publisher(ORDER, side="magenta").put(CoachOrder(sequence=1))
    rig.ticks(1)
    orders = rig.host.simulation.orders
    assert orders[Side.CYAN].sequence < 1000
    assert orders[Side.MAGENTA].sequence == 1
    assert rig.health().accounts["team/cyan/order"].dropped[OVER_LIMIT] > 1000


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
