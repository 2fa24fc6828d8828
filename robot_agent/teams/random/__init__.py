"""A team that keeps the rules and otherwise acts at random: the lowest rung of the ladder."""

from robot_agent.teams.random.team import Random

__all__ = ["Random"]
