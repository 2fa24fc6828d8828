"""Which page drives which robot: two hands on one would pull it to and fro. Pure."""

from coach_gateway.web.pages import Page
from coach_gateway.web.protocol import AskDrive

HELD_S = 0.5
"""s of wall time for which a robot stays in a hand that says nothing; the host gives it back then, too."""


class Hands:
    """Every robot that is driven from a page."""

    def __init__(self) -> None:
        self._holders: dict[str, tuple[Page, float]] = {}

    def refusal(self, page: Page, ask: AskDrive, now: float) -> str | None:
        """Why a page may not drive this robot at wall time `now` in s; otherwise it is in its hand, or let go of."""
        holder, until = self._holders.get(ask.robot, (page, 0.0))
        if holder is not page and now < until:
            return f"{ask.robot} is driven from another page; it can be taken when that has given it back"
        if ask.hand.release:
            self._holders.pop(ask.robot, None)
        else:
            self._holders[ask.robot] = page, now + HELD_S
        return None
