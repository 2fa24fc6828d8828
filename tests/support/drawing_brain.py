"""A brain that lets its robot stand and draws one shape of each kind in its team frame."""

from robot_agent.sdk.contract import Briefing
from schemas.messages.command import Command
from schemas.messages.drawing import Drawing
from schemas.messages.sight import Sight


class DrawingBrain:
    """Draws on the half that its team attacks; the numbers are those that tests look for."""

    def __init__(self, briefing: Briefing) -> None:
        self._robot = briefing.robot

    def act(self, sight: Sight) -> Command:
        """Stand, and draw."""
        drawing = Drawing()
        drawing.value("tick", sight.tick)
        drawing.value("gap", 0.25)
        drawing.value("plan", "wait")
        drawing.point((2.0, 5.0), "#fe0102")
        drawing.line((4.0, -3.0), (8.0, -3.0), "#fe0102")
        drawing.circle((6.0, 2.0), 1.5, "#fe0102")
        drawing.polygon([(1.0, -6.0), (3.0, -6.0), (3.0, -5.0)], "#fe0102")
        drawing.text((8.0, 5.0), f"drawn by {self._robot}", "#fe0102")
        return Command(answers_tick=sight.tick, debug=drawing.debug())
