"""The clerk who takes actions to the referee: each is noted, judged in the next tick, and answered after it."""

from collections.abc import Sequence

from schemas.bus.contract import Bus, Question
from schemas.game import ActionReply, RefereeAction
from schemas.message import BadMessageError
from schemas.topics import ACTION
from sim_host.complaints import Complaints


class ActionClerk:
    """Notes what the referee is asked for."""

    def __init__(self, bus: Bus, complaints: Complaints) -> None:
        self._questions = bus.serve(ACTION)
        self._complaints = complaints
        self._asked: list[Question] = []
        self.actions: list[RefereeAction] = []
        """Noted, and to be put to the referee in the next tick."""

    def attend(self) -> None:
        """Note the actions asked for."""
        while (question := self._questions.receive()) is not None:
            try:
                self.actions.append(question.message())
                self._asked.append(question)
            except BadMessageError as error:
                self._complaints.note(question.key, str(error), question.payload)
                question.fail(str(error))

    def reply(self, replies: Sequence[ActionReply]) -> None:
        """Answer the actions noted, in order, and forget them."""
        for question, reply in zip(self._asked, replies, strict=True):
            question.answer(reply)
        self._asked.clear()
        self.actions.clear()

    def refuse(self, reason: str) -> None:
        """Answer the actions noted with a refusal, and forget them."""
        self.reply([ActionReply(accepted=False, reason=reason)] * len(self._asked))
