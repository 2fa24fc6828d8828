"""The control service of a recorder: pause, resume, split, snapshot, status."""

from collections import deque
from collections.abc import Callable

from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.sink import Sink
from schemas.bus.contract import Bus, Query
from schemas.messages.recorder import RecorderOperation, RecorderReply, RecorderRequest
from schemas.topics import RECORDER_CONTROL
from schemas.wire.message import BadMessageError


class ControlService:
    """Replies to control queries between two polls of the bus."""

    def __init__(self, bus: Bus, name: str, sink: Sink) -> None:
        self._server = bus.serve(RECORDER_CONTROL, name=name)
        self._requests: deque[Query] = deque()
        self._name, self._sink = name, sink
        self.paused = False
        self._actions: dict[RecorderOperation, Callable[[], str]] = {
            RecorderOperation.STATUS: lambda: "",
            RecorderOperation.PAUSE: self._pause,
            RecorderOperation.RESUME: self._resume,
            RecorderOperation.SPLIT: sink.split,
            RecorderOperation.SNAPSHOT: lambda: sink.snapshot("request"),
        }

    def has_requests(self) -> bool:
        """Whether a query is waiting."""
        self._requests.extend(iter(self._server.receive, None))
        return bool(self._requests)

    def answer_requests(self, messages: int, loss_counts: LossCounts, tick: int) -> None:
        """Carry out waiting requests, and reply with the status of the recorder."""
        while self.has_requests():
            query = self._requests.popleft()
            try:
                request: RecorderRequest = query.message()
            except BadMessageError as error:
                query.fail(str(error))
                continue
            self._answer(query, self._actions[request.operation](), messages, sum(loss_counts.losses.values()), tick)

    def _answer(self, query: Query, reason: str, messages: int, lost: int, tick: int) -> None:
        query.reply(
            RecorderReply(
                accepted=not reason,
                reason=reason,
                recorder=self._name,
                paused=self.paused,
                file=str(self._sink.path),
                messages=messages,
                lost=lost,
                tick=tick,
            )
        )

    def _pause(self) -> str:
        if self.paused:
            return "it is already paused"
        self.paused = True
        return ""

    def _resume(self) -> str:
        if not self.paused:
            return "it is not paused"
        self.paused = False
        return ""
