"""What of a match a policy sees and controls: the settings that environment and match share.

They are parameters of the team in the match file, so that training and match read the same ones:

    [teams.cyan.parameters]
    decision_ticks = 5
    obstacles = 4
    observe = "motion ball mates"
    act = "vx kick power"
    corrects = "my_team:Brain"
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Self

from schemas.config.match_parts import Parameter
from schemas.config.shipped_teams import policy_file
from schemas.errors import TouchlineError, did_you_mean

GROUPS = ("place", "motion", "ball", "goals", "mates", "obstacles", "zones", "sensors", "time")
"""Groups of entries of an observation, in their order."""
ACTS = ("vx", "vy", "omega", "kick", "power", "dribble")
"""Entries of an action, in their order."""


@dataclass(frozen=True, slots=True)
class Interface:
    """The settings of a policy."""

    decision_ticks: int = 5
    """Control ticks between two decisions; in between the last one stays in force."""
    obstacles: int = 6
    """How many of the nearest obstacles are observed."""
    observe: tuple[str, ...] = GROUPS
    """The groups that are observed, as far as the match has them."""
    act: tuple[str, ...] = ACTS
    """The entries of an action, as far as the robot and the match have them; the others are 0."""
    corrects: str = ""
    """The brain whose commands the policy corrects, such as `module:Class`; empty where the policy commands alone."""

    @classmethod
    def of(cls, parameters: Mapping[str, Parameter]) -> Self:
        """The settings in the parameters of a team; others are the team's own.

        Raises:
            TouchlineError: a value is of another type, out of range, or names no group.
        """
        corrects = parameters.get("corrects", "")
        if not isinstance(corrects, str) or policy_file(corrects):
            raise TouchlineError(f'parameter corrects is {corrects!r}; write a brain of code, such as "module:Class"')
        return cls(
            decision_ticks=_whole(parameters, "decision_ticks", cls().decision_ticks, 1, 1000),
            obstacles=_whole(parameters, "obstacles", cls().obstacles, 0, 100),
            observe=_words(parameters, "observe", GROUPS),
            act=_words(parameters, "act", ACTS),
            corrects=corrects,
        )


SETTINGS = tuple(field.name for field in fields(Interface))
"""Names of the settings."""


def _words(parameters: Mapping[str, Parameter], name: str, known: tuple[str, ...]) -> tuple[str, ...]:
    said = parameters.get(name, " ".join(known))
    if not isinstance(said, str) or not said.split():
        raise TouchlineError(f"parameter {name} is {said!r}; write words, such as {' '.join(known[:3])!r}")
    for word in said.split():
        if word not in known:
            raise TouchlineError(f'parameter {name} names "{word}"; {did_you_mean(word, known)}')
    return tuple(word for word in known if word in said.split())


def _whole(parameters: Mapping[str, Parameter], name: str, default: int, least: int, most: int) -> int:
    value = parameters.get(name, default)
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise TouchlineError(f"parameter {name} is {value!r}; write a whole number from {least} to {most}")
    return value
