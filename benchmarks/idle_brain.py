"""A brain that answers at once, to measure everything but brains."""

from schemas.messages.command import Command
from schemas.messages.sight import Sight


def act(sight: Sight) -> Command:
    """Stand still."""
    return Command(answers_tick=sight.tick)
