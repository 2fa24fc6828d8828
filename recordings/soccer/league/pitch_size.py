"""Recognises the pitch of a log by how far the robots go: a log does not contain its pitch."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from recordings.soccer.league.team_log import TeamLog
from schemas.config.profile import load_profile

DEFAULT = "msl"
_PITCHES = ("paper", "msl")
"""Profiles whose pitches the league has used, the smaller one first."""
_SHARE = 0.99
"""Share of the records in which robots are within the pitch. Chosen here: the rest are errors of localisation."""
_BEYOND_M = 0.6
"""m; robots go this far beyond a goal line: their radius, and an error of localisation. Chosen here."""
_SHORT_OF_M = 1.5
"""m; a goalkeeper stands at most this far before its goal line for most of the match. Chosen here."""
_ENOUGH = 250
"""Records of robots, below which the pitch is not recognised. Chosen here: a second of ten robots."""


class RecognisedPitch(NamedTuple):
    """The pitch of an import."""

    profile: str
    note: str
    """How it was chosen, as a sentence; empty if nothing contradicts it."""


def recognise_pitch(teams: Iterable[TeamLog], profile: str | None) -> RecognisedPitch:
    """The profile with the pitch of a log; `profile` is the user's choice, which is kept, or None."""
    ways = [abs(row[2]) for log in teams for rows in log.robots.values() for row in rows]
    if len(ways) < _ENOUGH:
        return RecognisedPitch(profile or DEFAULT, "")
    reach = float(np.quantile(ways, _SHARE))
    lines = {name: load_profile(name).field.goal_line for name in _PITCHES}
    fits = next((name for name in _PITCHES if lines[name] - _SHORT_OF_M <= reach <= lines[name] + _BEYOND_M), None)
    chosen = profile or fits or DEFAULT
    pitch = load_profile(chosen).field
    size = f"{pitch.length:g} × {pitch.width:g} m"
    if profile is None and chosen != DEFAULT:
        return RecognisedPitch(
            chosen, f"robots go up to {reach:.1f} m from the middle: taken for a pitch of {size}, profile {chosen}"
        )
    if (fits is not None and lines[fits] != pitch.goal_line) or reach > pitch.goal_line + _BEYOND_M:
        other = f"; --profile {fits} fits" if fits is not None else ""
        return RecognisedPitch(
            chosen, f"robots go up to {reach:.1f} m from the middle, which does not fit the pitch of {size}{other}"
        )
    return RecognisedPitch(chosen, "")
