"""The teams that ship, by name, and the brain that the name of a team stands for."""

import re

from schemas.errors import TouchlineError, did_you_mean

SHIPPED_TEAMS = {
    name.lower(): f"robot_agent.teams.{name.lower()}:{name}" for name in ("NuBot", "Random", "Reference", "Simple")
}
"""Name of a shipped team → `module:Class` of its brain."""
_SPEC = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*:[^\W\d]\w*")


def brain_of(team: str) -> str:
    """`module:Class` of a team: that of the shipped team of this name, or the text itself.

    Raises:
        TouchlineError: no team of this name ships, and it is no `module:Class`.
    """
    if remedy := wrong_team(team):
        raise TouchlineError(f'team is "{team}"; {remedy}')
    return SHIPPED_TEAMS.get(team, team)


def wrong_team(team: str) -> str:
    """What to write in place of a text that names no team; empty if it names one."""
    if team in SHIPPED_TEAMS or _SPEC.fullmatch(team):
        return ""
    hint = "" if ":" in team else f"; {did_you_mean(team, SHIPPED_TEAMS)}"
    return f'write "module:Class", or the name of a shipped team{hint}'
