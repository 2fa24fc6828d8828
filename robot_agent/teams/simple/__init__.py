"""A plain team: keeper, striker, and up to nine places in a formation that moves with the ball."""

from robot_agent.teams.simple.team import Simple

__all__ = ["Simple"]
