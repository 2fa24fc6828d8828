"""The seat of the referee: the first that officiates holds it until it leaves, or until another one takes it.

A referee is whatever sends its actions under one name: all pages and programs with the referee's token of one gateway,
the terminals of one user, or one league's box. Stops are accepted from everybody, and coaches need no seat for what
they may request. A box takes the seat by connecting, since it is connected for that purpose alone.
"""

from typing import NamedTuple

from schemas.messages.soccer.game import RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation, SeatReply, SeatRequest
from schemas.soccer.game import REFBOX, ActionName

FREE = (ActionName.STOP, ActionName.NAME_ROBOT, ActionName.REPAIR, ActionName.SUBSTITUTE, ActionName.ENTER)
"""Actions that need no seat: a stop for safety, and what coaches may request."""
BESIDE_A_BOX = (ActionName.STOP, ActionName.NAME_ROBOT)
"""Actions of other clients while a league's referee box officiates."""
BOX_DECIDES = (
    "a league's referee box is connected and officiates; only stop, and name robot when it is asked for, are accepted"
)
_MAX_REFUSED = 100
"""Most names of refused referees that are kept; a flood of invented names must not fill the memory."""


class Holder(NamedTuple):
    """A referee."""

    referee: str | None
    """Its name; None for a client that gives none."""
    source: str
    """Its name for display."""

    def __str__(self) -> str:
        return f"{self.source} ({self.referee or 'unnamed'})"


class RefereeSeat:
    """Who officiates, and what has changed since the last report."""

    def __init__(self) -> None:
        self.holder: Holder | None = None
        self._box_connected = False
        self._refused: set[str | None] = set()
        """Names of referees that have been refused since the seat last changed hands."""
        self._changes: list[str] = []

    def update_box(self, connected: bool) -> None:
        """A league's box takes the seat when it connects, and frees it when it has gone."""
        if connected is self._box_connected:
            return
        self._box_connected = connected
        if connected and self.holder is not None and self.holder.source != REFBOX:
            self._changes.append(f"a league's referee box takes the seat of {self.holder}")
        self._set(None)

    def forget(self, referee: str) -> None:
        """A referee has left."""
        if self.holder is not None and self.holder.referee == referee:
            self._changes.append(f"{self.holder} has gone and officiates no more")
            self._set(None)

    def refusal(self, action: RefereeAction) -> str | None:
        """Why an action is refused, or None; a referee takes a free seat with its first request."""
        is_box = action.source == REFBOX
        if self._box_connected and not is_box:
            return None if action.action in BESIDE_A_BOX else self._refuse(action, BOX_DECIDES)
        if action.action in FREE and not is_box:
            return None
        sender = Holder(action.referee, action.source)
        if self.holder is None:
            self._set(sender)
            if sender.referee is not None:
                self._changes.append(f"{sender} officiates")
        if self.holder is None or self.holder.referee == sender.referee:
            return None
        remedy = "disconnect one of the two boxes" if is_box else "press Take over, or run touchline referee take-over"
        return self._refuse(action, f"{self.holder} officiates; {remedy}")

    def handle(self, request: SeatRequest) -> SeatReply:
        """Show, take or leave the seat."""
        reason = self._why_not(request)
        if not reason and request.operation is SeatOperation.TAKE:
            self._take(Holder(request.referee, request.source))
        elif not reason and request.operation is SeatOperation.LEAVE:
            self._changes.append(f"{self.holder} officiates no more")
            self._set(None)
        shown = self.holder or ("a league's referee box" if self._box_connected else None)
        return SeatReply(accepted=not reason, reason=reason, holder=str(shown) if shown is not None else None)

    def pop_changes(self) -> list[str]:
        """What has changed since the last call, as sentences."""
        changes, self._changes = self._changes, []
        return changes

    def _why_not(self, request: SeatRequest) -> str:
        if request.operation is SeatOperation.SHOW:
            return ""
        if request.referee is None:
            return f"{request.operation} needs the name of a referee"
        if self._box_connected:
            return "a league's referee box is connected and officiates; disconnect it first"
        if request.operation is SeatOperation.LEAVE and (self.holder is None or self.holder.referee != request.referee):
            return f"the seat is not held by {Holder(request.referee, request.source)}"
        return ""

    def _take(self, sender: Holder) -> None:
        if self.holder is None:
            self._changes.append(f"{sender} officiates")
        elif self.holder.referee != sender.referee:
            self._changes.append(f"{sender} officiates in place of {self.holder}")
        self._set(sender)

    def _set(self, holder: Holder | None) -> None:
        self.holder = holder
        self._refused.clear()

    def _refuse(self, action: RefereeAction, reason: str) -> str:
        if action.referee not in self._refused and len(self._refused) < _MAX_REFUSED:
            self._refused.add(action.referee)
            sender = Holder(action.referee, action.source)
            self._changes.append(f"{sender} is refused as referee ({action.action}): {reason.partition('; ')[0]}")
        return reason
