"""The teams that ship, by name, and the brain that a name or the file of a policy stands for."""

import re

from schemas.errors import TouchlineError, did_you_mean

SHIPPED_TEAMS = {
    name.lower(): f"robot_agent.teams.{name.lower()}:{name}" for name in ("NuBot", "Random", "Reference", "Simple")
}
"""Name of a shipped team → `module:Class` of its brain."""
POLICY_BRAIN = "touchline.policy.policy_brain:PolicyBrain"
"""The brain that plays a policy from a file."""
_POLICY = re.compile(r"policy:(.*\.\w+)")
_SPEC = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*:[^\W\d]\w*")


def brain_of(team: str) -> str:
    """`module:Class` of a team: that of the shipped team of this name, or the text itself.

    Raises:
        TouchlineError: no team of this name ships, and it is no `module:Class`.
    """
    if remedy := wrong_team(team):
        raise TouchlineError(f'team is "{team}"; {remedy}')
    return SHIPPED_TEAMS.get(team, team)


def policy_file(brain: str) -> str:
    """The file of the brain `policy:FILE`, whose name has a suffix; empty for any other brain."""
    found = _POLICY.fullmatch(brain)
    return found[1] if found else ""


def wrong_team(team: str) -> str:
    """What to write in place of a text that names no team; empty if it names one."""
    if team in SHIPPED_TEAMS or _SPEC.fullmatch(team) or policy_file(team):
        return ""
    hint = "" if ":" in team else f"; {did_you_mean(team, SHIPPED_TEAMS)}"
    return f'write "module:Class", "policy:FILE.zip", "policy:FILE.npz", or the name of a shipped team{hint}'
