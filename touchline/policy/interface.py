"""What of a match a policy sees and controls: the settings that environment and match share.

They are parameters of the team in the match file, so that training and match read the same ones:

    [teams.cyan.parameters]
    decision_ticks = 5
    obstacles = 4
    observe = "motion ball mates"
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

from schemas.config.match_parts import Parameter
from schemas.errors import TouchlineError, did_you_mean

GROUPS = ("place", "motion", "ball", "goals", "mates", "obstacles", "zones", "sensors", "time")
"""Groups of entries of an observation, in their order."""


@dataclass(frozen=True, slots=True)
class Interface:
    """The settings of a policy."""

    decision_ticks: int = 5
    """Control ticks between two decisions; in between the last one stays in force."""
    obstacles: int = 6
    """How many of the nearest obstacles are observed."""
    observe: tuple[str, ...] = GROUPS
    """The groups that are observed, as far as the match has them."""

    @classmethod
    def of(cls, parameters: Mapping[str, Parameter]) -> Self:
        """The settings in the parameters of a team; others are the team's own.

        Raises:
            TouchlineError: a value is of another type, out of range, or names no group.
        """
        groups = parameters.get("observe", " ".join(GROUPS))
        if not isinstance(groups, str) or not groups.split():
            raise TouchlineError(f"parameter observe is {groups!r}; write groups, such as {' '.join(GROUPS[:3])!r}")
        for group in groups.split():
            if group not in GROUPS:
                raise TouchlineError(f'parameter observe names "{group}"; {did_you_mean(group, GROUPS)}')
        return cls(
            decision_ticks=_whole(parameters, "decision_ticks", cls().decision_ticks, 1, 1000),
            obstacles=_whole(parameters, "obstacles", cls().obstacles, 0, 100),
            observe=tuple(group for group in GROUPS if group in groups.split()),
        )


def _whole(parameters: Mapping[str, Parameter], name: str, default: int, least: int, most: int) -> int:
    value = parameters.get(name, default)
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise TouchlineError(f"parameter {name} is {value!r}; write a whole number from {least} to {most}")
    return value
