"""Versions of what the program makes of the same numbers and inputs; recorded, so that `verify` can name a difference.

A change of behaviour belongs behind a number of profile or rule book, whose default keeps the behaviour of before:
older recordings are then verified as before. Where that is impossible, the version here is raised, and
`touchline verify` names the program that verifies the older recordings.
"""

from collections.abc import Mapping

WORLD_VERSION = 1
"""Version of physics, actuation and staging."""
REFEREE_VERSION = 1
"""Version of the referee."""


def program_versions() -> Mapping[str, str]:
    """Part of the program → its version, for the setup of a match."""
    return {"world_version": str(WORLD_VERSION), "referee_version": str(REFEREE_VERSION)}
