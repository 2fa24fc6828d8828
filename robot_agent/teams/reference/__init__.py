"""The reference team: one shared estimate, roles by assignment, passes by value, and parameters in one place."""

from robot_agent.teams.reference.team import Reference
from robot_agent.teams.reference.without_radio import WithoutRadio

__all__ = ["Reference", "WithoutRadio"]
