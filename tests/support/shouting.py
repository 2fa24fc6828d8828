"""A brain that sends script in every text of its radio message."""

from robot_agent.sdk.contract import Briefing
from schemas.messages.command import Command
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight

SCRIPT = "<img src=x onerror=steal()>"


class Shouting:
    """Stands still."""

    def __init__(self, briefing: Briefing) -> None:
        del briefing

    def act(self, sight: Sight) -> Command:
        radio = Radio(self=sight.self, role=SCRIPT, intention=SCRIPT, extra={SCRIPT: SCRIPT})
        return Command(answers_tick=sight.tick, radio=radio)
