"""The seat of the referee: one person, team of people, or box officiates at a time."""

from enum import StrEnum

from schemas.wire.message import Message, Name, Source


class SeatOperation(StrEnum):
    """What to do with the seat of the referee."""

    SHOW = "show"
    TAKE = "take"
    """Take the seat, whoever holds it."""
    LEAVE = "leave"
    """Free the seat for the next referee that officiates."""


class SeatRequest(Message):
    """A request for the seat of the referee."""

    operation: SeatOperation = SeatOperation.SHOW
    """What to do."""
    referee: Name | None = None
    """Name of the referee, which no other referee has; required to take or to leave."""
    source: Source = "coach"
    """Name of the sender, for display."""


class SeatReply(Message):
    """Who holds the seat of the referee after a request."""

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; empty where it was accepted."""
    holder: str | None = None
    """The referee that officiates, for display; None if the seat is free."""
