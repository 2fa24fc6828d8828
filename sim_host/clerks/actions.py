"""The clerk who takes actions to the referee: each is noted, judged in the next tick, and answered after it."""

from collections.abc import Callable, Sequence

from schemas.bus.contract import Bus, Question
from schemas.game import REFBOX, ActionName, ActionReply, RefereeAction
from schemas.message import BadMessageError
from schemas.topics import ACTION
from sim_host.complaints import Complaints

LOCKED = ActionReply(accepted=False, reason="a league's referee box is connected and officiates; only stop is left")


class ActionClerk:
    """Notes what the referee is asked for; while a league's referee box officiates, others may only stop the game."""

    def __init__(self, bus: Bus, complaints: Complaints, officiated: Callable[[], bool]) -> None:
        """`officiated` tells whether a referee box is connected."""
        self._questions = bus.serve(ACTION)
        self._complaints = complaints
        self._officiated = officiated
        self._asked: list[Question] = []
        self.actions: list[RefereeAction] = []
        """Noted, and to be put to the referee in the next tick."""

    def attend(self) -> None:
        """Note the actions asked for."""
        while (question := self._questions.receive()) is not None:
            try:
                action: RefereeAction = question.message()
            except BadMessageError as error:
                self._complaints.note(question.key, str(error), question.payload)
                question.fail(str(error))
                continue
            if self._officiated() and action.source != REFBOX and action.action is not ActionName.STOP:
                question.answer(LOCKED)
            else:
                self.actions.append(action)
                self._asked.append(question)

    def reply(self, replies: Sequence[ActionReply]) -> None:
        """Answer the actions noted, in order, and forget them."""
        for question, reply in zip(self._asked, replies, strict=True):
            question.answer(reply)
        self._asked.clear()
        self.actions.clear()

    def refuse(self, reason: str) -> None:
        """Answer the actions noted with a refusal, and forget them."""
        self.reply([ActionReply(accepted=False, reason=reason)] * len(self._asked))
