"""The ledger of each robot over a stretch of a match, computed from the host's reports at its two ends."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import zip_longest

from schemas.messages.hardware import HardwareHealth
from schemas.messages.health import AccountHealth, Health, RobotHealth
from schemas.messages.latency_counts import quantile_ms
from schemas.side import Side

_NEVER = RobotHealth()
_NO_ACCOUNT = AccountHealth()


@dataclass(frozen=True, slots=True)
class RobotLedger:
    """The counts of one robot."""

    robot: str
    state: str
    """What its agent does at the end of the stretch: `answers`, `silent`, `absent`, `off` or `still`."""
    sights: int
    """Sights sent to its agent."""
    on_time: int
    """Answers to the newest sight."""
    late: int
    """Answers to an earlier sight."""
    missing: int
    """Ticks without an answer."""
    double: int
    """Answers to a sight that was already answered."""
    invalid: int
    """Payloads that were no commands."""
    lost_sights: int
    """Sights that did not reach the agent, or that it skipped for a newer one."""
    lost_commands: int
    """Commands that did not reach the host."""
    p50_ms: float | None
    """Median wall time from sight to command in ms."""
    p99_ms: float | None
    """99th percentile of the wall time from sight to command in ms."""
    radio_bytes: int
    """Bytes of its radio messages."""
    radio_share: float | None
    """Average share of its team's radio budget, 0 to 1; None for a robot that has left the roster."""
    radio_refused: int
    """Radio messages that were refused."""
    fault: str
    """Why its messages are no answers; empty if they are."""


@dataclass(frozen=True, slots=True)
class AccountLedger:
    """The counts of one account of the bus."""

    account: str
    messages: int
    """Messages that reached the host."""
    size: int
    """Bytes of these messages."""
    dropped: dict[str, int]
    """Reason → messages that were dropped for it."""


@dataclass(frozen=True, slots=True)
class Ledger:
    """The counts of all robots from one simulated time to another."""

    start: float
    """Simulated time in s of the report before the stretch; 0 for the beginning of the match."""
    end: float
    """Simulated time in s of its last report."""
    ticks: int
    """Control ticks of the stretch."""
    pace: str
    real_time_factor: float
    """Simulated seconds per wall second, over the last second."""
    late_ticks: int
    """Ticks that began late; in lockstep, ticks without all answers in time."""
    worst_tick_ms: float
    """Longest wall time of a tick in the last second, in ms."""
    robots: list[RobotLedger]
    accounts: list[AccountLedger]
    radio_busiest: dict[str, float]
    """Side → share of its radio budget in its busiest second since the match began, 0 to 1."""
    strangers: dict[str, int]
    """Command key → messages on it, for names that no robot of the match has."""
    recorders: dict[str, int]
    """Recorder → ticks that it is behind."""
    hardware: dict[str, HardwareHealth] = field(default_factory=dict)
    """Robot on hardware → its own newest report; none of a recording."""


def ledger_of(last: Health, sides: Mapping[str, Side], first: Health | None = None) -> Ledger:
    """The ledger from the report `first`, or from the beginning of the match, to the report `last`."""
    first = first or Health(tick=0, time=0.0, pace=last.pace, real_time_factor=0.0)
    budgets = {side: use.budget for side, use in last.radio.items()}
    return Ledger(
        start=first.time,
        end=last.time,
        ticks=last.tick - first.tick,
        pace=last.pace,
        real_time_factor=last.real_time_factor,
        late_ticks=last.late_ticks - first.late_ticks,
        worst_tick_ms=last.worst_tick_ms,
        robots=[
            _robot_ledger(
                name,
                robot,
                first.robots.get(name, _NEVER),
                last.time - first.time,
                budgets.get(sides[name]) if name in sides else None,
            )
            for name, robot in last.robots.items()
        ],
        accounts=[
            _account_ledger(name, account, first.accounts.get(name, _NO_ACCOUNT))
            for name, account in last.accounts.items()
        ],
        radio_busiest={side.value: _share(use.busiest, use.budget) for side, use in last.radio.items()},
        strangers=_increase(last.strangers, first.strangers),
        recorders=dict(last.recorders),
    )


def _robot_ledger(
    name: str, last: RobotHealth, first: RobotHealth, seconds: float, budget: float | None
) -> RobotLedger:
    late, lost_commands = last.late - first.late, last.lost_commands - first.lost_commands
    invalid, unanswered = last.invalid - first.invalid, last.unanswered - first.unanswered
    latencies = [now - then for now, then in zip_longest(last.latencies, first.latencies, fillvalue=0)]
    radio_bytes = last.radio_bytes - first.radio_bytes
    return RobotLedger(
        robot=name,
        state=_state(last),
        sights=last.sights - first.sights,
        on_time=last.answers - first.answers - late,
        late=late,
        missing=last.missed - first.missed,
        double=last.duplicates - first.duplicates,
        invalid=invalid,
        lost_sights=max(0, unanswered - lost_commands - invalid),
        lost_commands=lost_commands,
        p50_ms=quantile_ms(latencies, 0.5),
        p99_ms=quantile_ms(latencies, 0.99),
        radio_bytes=radio_bytes,
        radio_share=_share(8 * radio_bytes / seconds, budget) if budget is not None and seconds > 0.0 else None,
        radio_refused=last.radio_refused - first.radio_refused,
        fault=last.fault,
    )


def _account_ledger(name: str, last: AccountHealth, first: AccountHealth) -> AccountLedger:
    return AccountLedger(
        account=name,
        messages=last.messages - first.messages,
        size=last.size - first.size,
        dropped=_increase(last.dropped, first.dropped),
    )


def _state(robot: RobotHealth) -> str:
    if robot.removed:
        return "off"
    if robot.still:
        return "still"
    if not robot.alive:
        return "absent"
    return "answers" if robot.answering else "silent"


def _share(used: float, budget: float) -> float:
    """A share of the budget with six digits; 0 of none."""
    return round(used / budget, 6) if budget > 0.0 else 0.0


def _increase(last: Mapping[str, int], first: Mapping[str, int]) -> dict[str, int]:
    rises = {key: count - first.get(key, 0) for key, count in last.items()}
    return {key: rise for key, rise in rises.items() if rise}
