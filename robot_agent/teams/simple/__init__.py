"""A plain team of five roles: keeper, striker, defender and two supporters."""

from robot_agent.teams.simple.team import Simple

__all__ = ["Simple"]
