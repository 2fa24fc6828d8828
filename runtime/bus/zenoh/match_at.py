"""The match that the host at an endpoint plays, by the host's liveliness token."""

import zenoh

from runtime.bus.contract import BusError, PresenceKind
from runtime.process.clock import Clock
from runtime.process.timing import POLL_S, REPLY_S
from schemas.topics import ALIVE, key_prefix

_ALL_HOSTS = key_prefix("*") + ALIVE.fill(kind=PresenceKind.HOST)
_START = len(key_prefix("")) - 1


def match_at(session: zenoh.Session, connect: str, clock: Clock, deadline: float) -> str:
    """The name of the match at the endpoint of this session, queried until `deadline`.

    Raises:
        BusError: no match is played there, or more than one.
    """
    names = hosts_of(session, clock, deadline)
    if not names:
        raise BusError(f"--connect {connect}: no match is played there; start one with `touchline match`")
    if len(names) > 1:
        raise BusError(f"--connect {connect}: several matches are played there; choose one: --match {sorted(names)}")
    return names.pop()


def other_match(connect: str, match: str, played: set[str]) -> str:
    """The error of a client of this match at an endpoint where others are played."""
    names = ", ".join(f'"{name}"' for name in sorted(played))
    return f"--match {match}: the host at {connect} plays {names}; leave --match out, or give another --connect"


def hosts_of(session: zenoh.Session, clock: Clock, deadline: float) -> set[str]:
    """The matches whose hosts are present, queried until there is one or `deadline` is over."""
    while True:
        replies = session.liveliness().get(_ALL_HOSTS, timeout=REPLY_S)
        keys = [str(reply.ok.key_expr) for reply in replies if reply.ok is not None]
        if keys or clock.now() >= deadline:
            return {key[_START:].partition("/")[0] for key in keys}
        clock.sleep_until(clock.now() + POLL_S)
