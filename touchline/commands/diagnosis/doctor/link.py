"""Examines the way to a host on the bus: protocol, round trip, clock, and the robots of its match."""

import math
from collections.abc import Iterator, Sequence

from coach_gateway.match.host_client import HostClient
from runtime.bus.contract import Bus
from runtime.bus.zenoh.bus import ZenohBus
from runtime.bus.zenoh.round_trip import round_trips_s
from runtime.process.timing import POLL_S, REQUEST_S
from schemas.config.match_config import LOCKSTEP
from schemas.errors import TouchlineError
from schemas.messages.health import Health
from schemas.messages.setup import Setup
from schemas.topics import HEALTH, WORLD
from schemas.wire.message import VERSION, BadMessageError, valid
from touchline.commands.diagnosis.doctor.clock_offset import ClockOffset, clock_offset
from touchline.commands.diagnosis.doctor.finding import Finding, Status

_ROUND_TRIPS = 50
_OFFSET_S = 0.1
"""A larger difference of the two clocks is reported, in s of wall time."""


def examine_link(bus: ZenohBus) -> Iterator[Finding]:
    """The findings on a host that has accepted this client."""
    try:
        setup = HostClient(bus, REQUEST_S).setup()
    except (BadMessageError, TouchlineError) as error:
        yield _no_setup(bus, error)
        return
    yield Finding(
        "protocol",
        Status.OK,
        f'{setup.version} there, {VERSION} here; match "{bus.match}", profile {setup.profile}, rules {setup.rules}, '
        f"{setup.pace}",
    )
    times = round_trips_s(bus, _ROUND_TRIPS)
    yield round_trip_finding(times, setup)
    health, stamps = _listen(bus)
    yield clock_finding(clock_offset(stamps, min(times, default=0.0)))
    if health is not None:
        yield robots_finding(setup, health)


def round_trip_finding(times: Sequence[float], setup: Setup) -> Finding:
    """The round trip, compared with a tick where the host does not wait for answers."""
    if not times:
        return Finding("round trip", Status.FAILED, "no round trip was completed", "is the network overloaded?")
    ordered = sorted(times)
    p50, p99 = (ordered[min(len(ordered) - 1, math.floor(share * len(ordered)))] for share in (0.5, 0.99))
    text = f"p50 {p50 * 1e3:.2f} ms, p99 {p99 * 1e3:.2f} ms, of {len(times)}"
    tick = setup.time.tick
    if setup.pace != LOCKSTEP and p99 >= tick:
        return Finding(
            "round trip",
            Status.WARNING,
            f"{text}; a tick lasts {tick * 1e3:g} ms, so commands are up to {math.ceil(p99 / tick)} ticks old",
            "use a cable, or a Wi-Fi channel of its own",
        )
    return Finding("round trip", Status.OK, text)


def clock_finding(offset: ClockOffset | None) -> Finding:
    """The difference of the clocks, which matters for the times in logs only."""
    if offset is None:
        return Finding(
            "clock", Status.WARNING, "the host has published nothing, so its clock is unknown", "is it suspended?"
        )
    text = f"the host's clock is {abs(offset.seconds):.4f} s {'ahead' if offset.seconds > 0 else 'behind'}"
    text = f"{text}, ± {offset.uncertainty:.4f} s"
    if abs(offset.seconds) - offset.uncertainty > _OFFSET_S:
        remedy = "timedatectl set-ntp true, on both machines; robots play all the same, times in logs do not agree"
        return Finding("clock", Status.WARNING, text, remedy)
    return Finding("clock", Status.OK, text)


def robots_finding(setup: Setup, health: Health) -> Finding:
    """Which robots have an agent, and which are free."""
    present = {name for name, robot in health.robots.items() if robot.alive}
    free = [name for name in setup.sides if name not in present]
    taken = [name for name in setup.sides if name in present]
    return Finding("robots", Status.OK, f"free: {', '.join(free) or 'none'}; taken: {', '.join(taken) or 'none'}")


def _no_setup(bus: Bus, error: Exception) -> Finding:
    if "is not supported" in str(error):
        return Finding("protocol", Status.FAILED, str(error), "install the same version of touchline on both machines")
    return Finding(
        "protocol",
        Status.FAILED,
        f'the host does not report the setup of match "{bus.match}" ({error})',
        "leave --match out to join the match that is played there; is the process stopped?",
    )


def _listen(bus: Bus) -> tuple[Health | None, list[tuple[int, int]]]:
    """The newest report on the host's health, and times of sending and arrival of new messages, in ns."""
    subscriptions = [history := bus.subscribe(HEALTH, history=True), bus.subscribe(HEALTH), bus.subscribe(WORLD)]
    newest, stamps = None, []
    until = bus.clock.now() + REQUEST_S
    while bus.clock.now() < until:
        for subscription in subscriptions:
            if (received := subscription.receive(POLL_S)) is None:
                continue
            if received.stamp is not None and subscription is not history:
                stamps.append((received.stamp.sent_ns, bus.clock.unix_ns()))
            if received.topic is HEALTH:
                newest = valid(received.message) or newest
    for subscription in subscriptions:
        subscription.close()
    return newest, stamps
