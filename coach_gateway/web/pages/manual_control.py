"""Which page drives which robot: two pages at the same time would pull a robot to and fro. Pure."""

from coach_gateway.web.pages.open_pages import Page
from coach_gateway.web.pages.protocol import PageDrive
from schemas.messages.manual import TIMEOUT_S


class ManualControl:
    """The robots that are driven from pages."""

    def __init__(self) -> None:
        self._holders: dict[str, tuple[Page, float]] = {}

    def refusal(self, page: Page, request: PageDrive, now: float) -> str | None:
        """Why a page may not drive this robot at wall time `now` in s; otherwise it now holds or releases it."""
        holder, until = self._holders.get(request.robot, (page, 0.0))
        if holder is not page and now < until:
            return f"{request.robot} is driven from another page; it can be taken once that page has released it"
        if request.manual.release:
            self._holders.pop(request.robot, None)
        else:
            self._holders[request.robot] = page, now + TIMEOUT_S
        return None
