"""The recorder's ear for its operator: pause, resume, split, snapshot, status."""

from collections import deque
from collections.abc import Callable

from recordings.account import Account
from recordings.output import Output
from schemas.bus.contract import Bus, Question
from schemas.control import RecorderDeed, RecorderReply, RecorderRequest
from schemas.message import BadMessageError
from schemas.topics import CONTROL


class Controls:
    """Answers between two looks at the bus."""

    def __init__(self, bus: Bus, name: str, output: Output) -> None:
        self._server = bus.serve(CONTROL, name=name)
        self._asked: deque[Question] = deque()
        self._name, self._output = name, output
        self.paused = False
        self._deeds: dict[RecorderDeed, Callable[[], str]] = {
            RecorderDeed.STATUS: lambda: "",
            RecorderDeed.PAUSE: self._pause,
            RecorderDeed.RESUME: self._resume,
            RecorderDeed.SPLIT: output.split,
            RecorderDeed.SNAPSHOT: lambda: output.snapshot("request"),
        }

    def asked(self) -> bool:
        """Whether a question waits."""
        self._asked.extend(iter(self._server.receive, None))
        return bool(self._asked)

    def attend(self, messages: int, account: Account, tick: int) -> None:
        """Do what was asked for, and answer with how the recorder is doing."""
        while self.asked():
            question = self._asked.popleft()
            try:
                request: RecorderRequest = question.message()
            except BadMessageError as error:
                question.fail(str(error))
                continue
            self._answer(question, self._deeds[request.deed](), messages, sum(account.losses.values()), tick)

    def _answer(self, question: Question, reason: str, messages: int, lost: int, tick: int) -> None:
        question.answer(
            RecorderReply(
                accepted=not reason,
                reason=reason,
                recorder=self._name,
                paused=self.paused,
                file=str(self._output.path),
                messages=messages,
                lost=lost,
                tick=tick,
            )
        )

    def _pause(self) -> str:
        if self.paused:
            return "it is paused already"
        self.paused = True
        return ""

    def _resume(self) -> str:
        if not self.paused:
            return "it is not paused"
        self.paused = False
        return ""
