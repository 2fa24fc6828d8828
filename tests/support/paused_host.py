"""A host that plays on a thread of its own, paused and stepped by requests of the test."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from schemas.messages.pace import PaceOperation, PaceReply, PaceRequest
from schemas.topic import Topic
from schemas.topics import PACE
from schemas.wire.message import Message
from support.host_rig import HostRig

LIMIT_S = 60.0
PAUSE, RUN, STEP, SHOW = PaceOperation.PAUSE, PaceOperation.RUN, PaceOperation.STEP, PaceOperation.SHOW


@contextmanager
def playing(rig: HostRig, ticks: int) -> Iterator[None]:
    """The host plays so many ticks on another thread; the block ends when it has played them."""
    thread = threading.Thread(target=rig.ticks, args=(ticks,), daemon=True)
    thread.start()
    try:
        yield
    except BaseException:
        rig.outside.query(PACE, PaceRequest(operation=RUN))  # a block that fails leaves no thread in a pause
        raise
    finally:
        thread.join(LIMIT_S)
    assert not thread.is_alive()


@contextmanager
def paused_match(rig: HostRig) -> Iterator[None]:
    """The host plays on another thread until the block ends, after a pause at the present tick."""
    is_over = threading.Event()

    def play() -> None:
        while not is_over.is_set():
            rig.ticks(1)

    asked = rig.outside.query(PACE, PaceRequest(operation=PAUSE))
    thread = threading.Thread(target=play)
    thread.start()
    try:
        assert asked.result(LIMIT_S).paused
        yield
    finally:
        is_over.set()
        rig.outside.query(PACE, PaceRequest(operation=RUN))
        thread.join(LIMIT_S)
    assert not thread.is_alive()


def ask(rig: HostRig, request: Message, topic: Topic = PACE) -> Any:
    return rig.outside.query(topic, request).result(LIMIT_S)


def pace(rig: HostRig, operation: PaceOperation, **content: Any) -> PaceReply:
    reply = ask(rig, PaceRequest(operation=operation, **content))
    assert isinstance(reply, PaceReply)
    return reply


def stepped_to(rig: HostRig, tick: int) -> None:
    """Step a paused match to this tick, and wait until it is there."""
    now = pace(rig, SHOW).tick
    reply = pace(rig, STEP, ticks=tick - now)
    assert (reply.accepted, reply.until) == (True, tick)
    while not (reply := pace(rig, SHOW)).paused:
        pass
    assert reply.tick == tick


@contextmanager
def paused(rig: HostRig, ticks: int) -> Iterator[None]:
    """Play so many ticks on another thread, which the match does after a pause at the present tick."""
    asked, now = rig.outside.query(PACE, PaceRequest(operation=PAUSE)), rig.host.simulation.now.tick
    with playing(rig, ticks):
        assert asked.result(LIMIT_S) == PaceReply(accepted=True, tick=now, paused=True, until=now)
        yield
