"""Control of a replay, which publishes a recording on the bus."""

from enum import StrEnum
from typing import Annotated, ClassVar

from msgspec import Meta

from schemas.messages.soccer.game import GameEvent
from schemas.wire.message import Message
from schemas.wire.part import Part


class ReplayOperation(StrEnum):
    """What a replay can do on request."""

    STATUS = "status"
    """Report its state, and change nothing."""
    EVENTS = "events"
    """Report its state and all events of the recording, of any other file its topics, and change nothing."""
    PLAY = "play"
    PAUSE = "pause"
    STEP = "step"
    """Play `ticks` ticks, and pause."""
    SEEK = "seek"
    """Go to `to`, or by `by` from here, and publish the state at that point."""
    RATE = "rate"
    """Play at `rate`, or as fast as possible where it is None."""
    LOOP = "loop"
    """Switch between starting again at the end and ending there."""
    LEAVE = "leave"
    """End the replay."""


class ReplayRequest(Message):
    """A request to a replay."""

    operation: ReplayOperation = ReplayOperation.STATUS
    """What to do."""
    to: str | None = None
    """Target of a seek: simulated time in s, or an event, `goal:2`, `kick_off:1-5`."""
    by: float | None = None
    """Distance of a seek from here in simulated time, in s; negative for backward."""
    rate: Annotated[float, Meta(gt=0)] | None = None
    """Simulated seconds per wall second; None for as fast as possible."""
    ticks: Annotated[int, Meta(ge=1)] = 1
    """Length of a step in ticks."""


class ReplayTopic(Part):
    """A topic of a file that is no recording of a match."""

    key: str
    """The key on which its messages are replayed."""
    encoding: str
    """As the file names it, such as `cdr`."""
    schema: str = ""
    """Name of its schema; empty without one."""
    messages: int = 0
    """Messages in the file."""
    start: float = 0.0
    """Time of the first one, in s since the first message of all topics."""
    end: float = 0.0
    """Time of the last one, in s since then."""


class ReplayReply(Message):
    """A replay's reply, with its state after the request."""

    max_bytes: ClassVar[int] = 8_000_000

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; empty where it was accepted."""
    time: float = 0.0
    """Position in simulated time, in s."""
    start: float = 0.0
    """Start of the replayed part in simulated time, in s."""
    end: float = 0.0
    """End of the replayed part in simulated time, in s; while the match is still being recorded, the newest time so
    far."""
    rate: float | None = None
    """Simulated seconds per wall second; None for as fast as possible."""
    paused: bool = False
    """The replay is paused."""
    loop: bool = False
    """The replay starts again at its end."""
    messages: int = 0
    """Messages published so far."""
    events: list[GameEvent] = []
    """All events of the recording in order, where they were requested."""
    topics: list[ReplayTopic] = []
    """The topics of any other file, where events were requested."""
