"""A clerk who answers each question of one topic as soon as it is read."""

from collections.abc import Callable
from typing import Any

from schemas.bus.contract import Bus
from schemas.message import BadMessageError, Message
from schemas.topic import Topic
from sim_host.complaints import Complaints


class PromptClerk:
    """Answers one topic."""

    def __init__(self, bus: Bus, topic: Topic, answer: Callable[[Any], Message], complaints: Complaints) -> None:
        """`answer` is given the valid question, and gives the reply."""
        self._questions = bus.serve(topic)
        self._answer = answer
        self._complaints = complaints

    def attend(self) -> None:
        """Answer all that were asked."""
        while (question := self._questions.receive()) is not None:
            try:
                asked = question.message()
            except BadMessageError as error:
                self._complaints.note(question.key, str(error), question.payload)
                question.fail(str(error))
                continue
            question.answer(self._answer(asked))
