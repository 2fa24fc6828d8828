"""The paper's robots: one behaviour state machine with the paper's own constants, extended to a match."""

from robot_agent.teams.nubot.team import NuBot

__all__ = ["NuBot"]
