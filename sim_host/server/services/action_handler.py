"""The handler of referee actions: each is queued, decided in the next tick, and replied to after that tick."""

from collections.abc import Sequence

from runtime.bus.contract import Bus, Query
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.topics import ACTION
from schemas.wire.message import BadMessageError
from sim_host.server.admission.door import InvalidLog
from sim_host.server.services.referee_seat import RefereeSeat


class ActionHandler:
    """Queues requested actions of the referee that holds the seat, and those that need no seat."""

    def __init__(self, bus: Bus, invalid_log: InvalidLog, seat: RefereeSeat) -> None:
        self._server = bus.serve(ACTION)
        self._invalid_log = invalid_log
        self._seat = seat
        self._pending: list[Query] = []
        self.actions: list[RefereeAction] = []
        """Requested actions, which the referee decides on in the next tick."""

    def process(self) -> None:
        """Queue the actions that have been requested."""
        while (query := self._server.receive()) is not None:
            try:
                action: RefereeAction = query.message()
            except BadMessageError as error:
                self._invalid_log.add(query.key, str(error), query.payload)
                query.fail(str(error))
                continue
            reason = self._seat.refusal(action)
            if reason is not None:
                query.reply(ActionReply(accepted=False, reason=reason))
            else:
                self.actions.append(action.replace(referee=None))
                self._pending.append(query)

    def reply(self, replies: Sequence[ActionReply]) -> None:
        """Reply to the queued actions, in order, and clear the queue."""
        for query, reply in zip(self._pending, replies, strict=True):
            query.reply(reply)
        self._pending.clear()
        self.actions.clear()

    def refuse(self, reason: str) -> None:
        """Refuse the queued actions, and clear the queue."""
        self.reply([ActionReply(accepted=False, reason=reason)] * len(self._pending))
