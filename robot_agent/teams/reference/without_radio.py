"""The reference team with its radios off: what collaboration is worth is the difference to the team itself."""

import msgspec

from robot_agent.teams.reference.team import Reference
from schemas.messages.command import Command
from schemas.messages.sight import Sight


class WithoutRadio(Reference):
    """A robot that neither sends nor receives."""

    def act(self, sight: Sight) -> Command:
        """The answer of the reference team to a sight without messages, without a message of its own."""
        command = super().act(msgspec.structs.replace(sight, radio={}))
        return msgspec.structs.replace(command, radio=None)
