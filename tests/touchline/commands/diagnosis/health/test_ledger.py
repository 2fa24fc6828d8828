"""The ledger of each robot, computed from the reports at the two ends of a stretch."""

from typing import Any

import pytest

from schemas.messages.health import AccountHealth, Health, RobotHealth, TeamRadio
from schemas.messages.latency_counts import CLASSES, class_of
from schemas.side import Side
from schemas.wire.part_faults import validated
from touchline.commands.diagnosis.health.ledger import RobotLedger, ledger_of

SIDES = {"cyan1": Side.CYAN, "magenta1": Side.MAGENTA}


def report(tick: int, **more: Any) -> Health:
    return Health(tick=tick, time=tick * 0.02, pace="realtime", real_time_factor=1.0, **more)


def counted(**counts: Any) -> RobotHealth:
    known = {"sights": 0, "unanswered": 0, "late": 0, "lost_commands": 0, "radio_bytes": 0, "radio_refused": 0}
    return validated(RobotHealth, {"alive": True, "answering": True, **known, **counts})


def latencies(**by_ms: int) -> list[int]:
    counts = [0] * CLASSES
    for ms, count in by_ms.items():
        counts[class_of(float(ms[1:]) * 1e-3)] += count
    return counts


def only_robot(last: Health, first: Health | None = None) -> RobotLedger:
    (row,) = ledger_of(last, SIDES, first).robots
    return row


def test_answers_are_on_time_or_late() -> None:
    row = only_robot(report(100, robots={"cyan1": counted(sights=100, answers=90, late=15, missed=10, duplicates=3)}))
    assert (row.sights, row.on_time, row.late, row.missing, row.double) == (100, 75, 15, 10, 3)


def test_sights_without_an_answer_that_no_lost_or_invalid_command_explains_were_lost_or_skipped() -> None:
    row = only_robot(report(100, robots={"cyan1": counted(unanswered=20, lost_commands=12, invalid=3)}))
    assert (row.lost_sights, row.lost_commands, row.invalid) == (5, 12, 3)


def test_a_stretch_has_the_increase_of_every_count() -> None:
    first = report(
        100,
        late_ticks=4,
        robots={
            "cyan1": counted(sights=100, answers=90, late=5, missed=10, radio_bytes=1000, latencies=latencies(_400=90))
        },
    )
    last = report(
        200,
        late_ticks=5,
        robots={
            "cyan1": counted(
                sights=200, answers=188, late=7, missed=12, radio_bytes=5000, latencies=latencies(_400=90, _10=98)
            )
        },
        radio={Side.CYAN: TeamRadio(budget=1e5, busiest=5e4)},
    )
    ledger = ledger_of(last, SIDES, first)
    (row,) = ledger.robots
    assert (ledger.start, ledger.end, ledger.ticks, ledger.late_ticks) == (2.0, 4.0, 100, 1)
    assert (row.sights, row.on_time, row.late, row.missing) == (100, 96, 2, 2)
    assert row.p99_ms == pytest.approx(10, rel=0.2), "the slow answers came before"
    assert (row.radio_bytes, row.radio_share) == (4000, pytest.approx(0.16))
    assert ledger.radio_busiest == {"cyan": 0.5}


def test_a_robot_that_joined_in_the_stretch_is_counted_from_its_beginning() -> None:
    row = only_robot(report(200, robots={"cyan1": counted(sights=50, answers=50)}), report(100))
    assert (row.sights, row.on_time) == (50, 50)


@pytest.mark.parametrize(
    ("robot", "state"),
    [
        (counted(), "answers"),
        (counted(answering=False), "silent"),
        (counted(alive=False), "absent"),
        (counted(removed=True), "off"),
        (counted(still=True), "still"),
    ],
)
def test_the_state_of_an_agent_is_one_word(robot: RobotHealth, state: str) -> None:
    assert only_robot(report(9, robots={"cyan1": robot})).state == state


def test_messages_of_strangers_are_those_of_the_stretch() -> None:
    first, last = report(1, strangers={"robot/x/command": 5}), report(9, strangers={"robot/x/command": 5, "others": 2})
    assert ledger_of(last, SIDES, first).strangers == {"others": 2}


def test_an_account_has_its_messages_and_what_was_dropped_of_them_in_the_stretch() -> None:
    first = report(100, accounts={"cyan": AccountHealth(messages=90, size=9000, dropped={"too long": 2})})
    last = report(
        200,
        accounts={
            "cyan": AccountHealth(messages=190, size=20000, dropped={"too long": 2, "too many": 7}),
            "viewer": AccountHealth(messages=1, size=10),
        },
    )
    cyan, viewer = ledger_of(last, SIDES, first).accounts
    assert (cyan.messages, cyan.size, cyan.dropped) == (100, 11000, {"too many": 7})
    assert (viewer.account, viewer.messages, viewer.dropped) == ("viewer", 1, {})
