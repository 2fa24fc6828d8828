"""Round trips of a client to its host's router, without the host's own Python."""

from runtime.bus.contract import PresenceKind
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.timing import REPLY_S
from schemas.topics import ALIVE, key_prefix


def round_trips_s(bus: ZenohBus, count: int) -> list[float]:
    """Wall times in s of `count` queries for the host's token; those without a reply are left out."""
    key = key_prefix(bus.match) + ALIVE.fill(kind=PresenceKind.HOST)
    times = []
    for _ in range(count):
        began = bus.clock.now()
        replies = bus.session.liveliness().get(key, timeout=REPLY_S)
        if any(reply.ok is not None for reply in replies):
            times.append(bus.clock.now() - began)
    return times
