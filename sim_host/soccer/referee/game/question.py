"""A question to a side: which of its robots does an action concern that names none?"""

from typing import NamedTuple

from schemas.messages.soccer.game import RobotQuestion
from schemas.side import Side
from schemas.soccer.game import ActionName

ANSWER_S = 10.0
"""s of simulated time for the answer (ours)."""


class Question(NamedTuple):
    """An action that waits for its robot."""

    action: ActionName
    side: Side
    source: str
    """The sender of the action."""
    robots: tuple[str, ...]
    """The robots that the action was allowed for when the question was opened."""
    default: str
    """The robot that is taken without an answer."""
    left: float = ANSWER_S
    """s to answer."""

    def after(self, dt: float) -> "Question":
        """The question `dt` s later."""
        return self._replace(left=self.left - dt)

    def published(self) -> RobotQuestion:
        """The question as it is published."""
        return RobotQuestion(
            action=self.action,
            side=self.side,
            left=max(0.0, round(self.left, 3)),
            robots=list(self.robots),
            default=self.default,
        )
