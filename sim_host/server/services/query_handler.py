"""A handler that replies to each query of one topic as soon as it is received."""

from collections.abc import Callable
from typing import Any

from runtime.bus.contract import Bus
from schemas.topic import Topic
from schemas.wire.message import BadMessageError, Message
from sim_host.server.admission.door import InvalidLog

_MOST_AT_ONCE = 32
"""Most queries in one call after a time with few, as at the start of a match."""
_MOST_IN_A_ROW = 1
"""Most queries in each call while they keep coming: a flood of them must not stop the match."""


class QueryHandler:
    """Replies to the queries of one topic."""

    def __init__(
        self,
        bus: Bus,
        topic: Topic,
        answer: Callable[[Any], Message],
        invalid_log: InvalidLog,
        report: Callable[[str], None] = lambda _: None,
    ) -> None:
        """`answer` returns the reply to a valid query; `report` receives the reason why a query is invalid."""
        self._server = bus.serve(topic)
        self._answer = answer
        self._invalid_log = invalid_log
        self._report = report
        self._allowed = _MOST_AT_ONCE

    def process(self, timeout: float = 0.0) -> None:
        """Reply to queries that have arrived; of a flood, the rest waits for the next call.

        Without one, it is waited for up to `timeout` s.
        """
        self._allowed = min(_MOST_AT_ONCE, self._allowed + _MOST_IN_A_ROW)
        while self._allowed and (query := self._server.receive(timeout)) is not None:
            self._allowed -= 1
            timeout = 0.0
            try:
                asked = query.message()
            except BadMessageError as error:
                self._invalid_log.add(query.key, str(error), query.payload)
                query.fail(str(error))
                self._report(str(error))
                continue
            query.reply(self._answer(asked))
