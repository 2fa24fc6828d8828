"""What may be asked of a replay while it runs: a recording that is brought back onto the bus."""

from enum import StrEnum
from typing import Annotated, ClassVar

from pydantic import Field

from schemas.game import GameEvent
from schemas.message import Message


class ReplayOperation(StrEnum):
    """What to do."""

    STATUS = "status"
    """Nothing: only say how it stands."""
    EVENTS = "events"
    """Nothing: also say all that happens in what is recorded."""
    PLAY = "play"
    PAUSE = "pause"
    STEP = "step"
    """Pause, and play `ticks` more."""
    SEEK = "seek"
    """Go to `to`, or `by` from here; everybody is told the state at that point."""
    RATE = "rate"
    """Play at `rate`, or as fast as possible when none is given."""
    LOOP = "loop"
    """Begin again at the end from now on, or no more when it did."""
    LEAVE = "leave"
    """End the replay."""


class ReplayRequest(Message):
    """Asks a replay to go on, stop, or go elsewhere."""

    operation: ReplayOperation = ReplayOperation.STATUS
    """What the replay is asked to do."""
    to: str | None = None
    """Where to: s of simulated time, or an event, `goal:2`, `kick_off:1-5`."""
    by: float | None = None
    """How far from here, in s of simulated time; back where it is negative."""
    rate: Annotated[float, Field(gt=0)] | None = None
    """Simulated seconds per wall second; as fast as possible when not given."""
    ticks: Annotated[int, Field(ge=1)] = 1
    """How many ticks a step has."""


class ReplayReply(Message):
    """How a replay stands after what was asked."""

    max_bytes: ClassVar[int] = 8_000_000

    accepted: bool
    """The replay did what it was asked to do."""
    reason: str = ""
    """Why it was refused."""
    time: float = 0.0
    """Where it is, s of simulated time."""
    start: float = 0.0
    """Where what is replayed begins, s of simulated time."""
    end: float = 0.0
    """Where it ends, s of simulated time; of a match that is still being recorded, how far that has come."""
    rate: float | None = None
    """Simulated seconds per wall second; None for as fast as possible."""
    paused: bool = False
    """The replay stands still."""
    loop: bool = False
    """The replay begins again at its end."""
    messages: int = 0
    """Messages sent so far."""
    events: list[GameEvent] = Field(default_factory=list)
    """All that happens in the recording, in order, where that was asked for."""
