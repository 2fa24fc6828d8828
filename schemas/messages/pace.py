"""Pausing a running match, and playing it tick by tick."""

from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.wire.message import Message, Source


class PaceOperation(StrEnum):
    """What an operator can do with the pace of a running match."""

    SHOW = "show"
    """Report the state, and change nothing."""
    PAUSE = "pause"
    RUN = "run"
    """Play on at the pace of the match."""
    STEP = "step"
    """Of a paused match: play `ticks` ticks, and pause again."""


class PaceRequest(Message):
    """A request to pause a match, to let it run or to step it; simulated time stands still during a pause."""

    operation: PaceOperation = PaceOperation.SHOW
    """What to do."""
    ticks: Annotated[int, Meta(ge=1, le=1_000_000_000)] = 1
    """Length of a step in ticks."""
    source: Source = "operator"
    """Name of the sender, for display."""


class PaceReply(Message):
    """The host's reply, with the state after the request; a step has begun then, and need not have ended."""

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; empty where it was accepted."""
    tick: int
    """Control ticks since the match began."""
    paused: bool
    """The match stands still at this tick."""
    until: int | None = None
    """The tick at which it pauses; None if it runs on."""
