"""Which team broke the limits of the bus, and which stopped answering, in a match that was played with processes.

The host plays such a match to its end: it drops what is too much, and does not wait for the silent for ever.
"""

from runtime.access.accounts import Account
from schemas.config.match_config import MatchConfig
from schemas.messages.health import Health, RobotHealth
from schemas.side import Side
from sim_host.server.admission.door import OVER_LIMIT
from touchline.matches.engine.outcome import FailureKind

_SILENT_TICKS = 50
"""Sights in a row that no robot of a side has answered after which the side counts as hung."""


def fault_of(health: Health | None, config: MatchConfig) -> tuple[FailureKind, tuple[Side, ...], str] | None:
    """The fault, the sides that have it and the reason, for a match that does not count; None if both played on."""
    for kind, reason_of in ((FailureKind.BROKE_ACCESS_RULES, breach_of), (FailureKind.HUNG, silence_of)):
        reasons = {side: reason for side in Side if (reason := reason_of(health, config, side)) is not None}
        if reasons:
            return kind, tuple(reasons), "; ".join(reasons.values())
    return None


def breach_of(health: Health | None, _: MatchConfig, side: Side) -> str | None:
    """How the account of a side broke the limits of the bus; None if it did not.

    Messages on keys that it has no right to are no breach: they never pass the router.
    """
    account = health.accounts.get(Account.of_team(side).value) if health is not None else None
    count = account.dropped.get(OVER_LIMIT, 0) if account is not None else 0
    return f"account {side.value}: {count} messages were dropped: {OVER_LIMIT}" if count else None


def silence_of(health: Health | None, config: MatchConfig, side: Side) -> str | None:
    """Since when no robot of a side answers; None if one does."""
    robots = [health.robots.get(name, RobotHealth()) for name in config.robots(side)] if health is not None else []
    missed = min((one.missed_in_a_row for one in robots), default=0)
    if missed < _SILENT_TICKS:
        return None
    return f"none of its robots has answered the last {missed} sights"
