"""The handler of referee actions: each is queued, decided in the next tick, and replied to after that tick."""

from collections.abc import Callable, Sequence

from schemas.bus.contract import Bus, Query
from schemas.game import REFBOX, ActionName
from schemas.messages.game import ActionReply, RefereeAction
from schemas.topics import ACTION
from schemas.wire.message import BadMessageError
from sim_host.server.invalid_log import InvalidLog

REFEREE_BOX_DECIDES = ActionReply(
    accepted=False,
    reason="a league's referee box is connected and officiates; only stop, and name robot when it is asked for, are "
    "accepted",
)
_UNLOCKED = (ActionName.STOP, ActionName.NAME_ROBOT)
"""Actions of other clients while a referee box officiates."""


class ActionHandler:
    """Queues requested actions.

    While a league's referee box officiates, other clients may only stop the game, and name robots that it asks for.
    """

    def __init__(self, bus: Bus, invalid_log: InvalidLog, has_referee_box: Callable[[], bool]) -> None:
        """`has_referee_box` returns whether a referee box is connected."""
        self._server = bus.serve(ACTION)
        self._invalid_log = invalid_log
        self._has_referee_box = has_referee_box
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
            if self._has_referee_box() and action.source != REFBOX and action.action not in _UNLOCKED:
                query.reply(REFEREE_BOX_DECIDES)
            else:
                self.actions.append(action)
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
