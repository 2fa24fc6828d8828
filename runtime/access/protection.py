"""How a host protects its match: who its clients are, and what each may do."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

from runtime.access.access_rules import access_rules, with_any_keys
from runtime.access.credentials import HostCredentials, read_host_credentials
from runtime.access.rights import Robots
from schemas.config.match_config import MatchConfig
from schemas.config.roster import MAX_ROBOTS
from schemas.errors import TouchlineError
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class Protection:
    """The protection of one match."""

    credentials: HostCredentials
    rules: Mapping[str, Any]
    """What each account may do: Zenoh's `access_control`."""

    @classmethod
    def of(cls, credentials: HostCredentials, match: str, robots: Robots) -> Self:
        """The protection of a match with these robots.

        Raises:
            TouchlineError: the credentials are for another match.
        """
        if credentials.match not in (None, match):
            raise TouchlineError(
                f'the credentials are for the match "{credentials.match}", not for "{match}"; '
                f"use --match {credentials.match}, or make others with `touchline credentials new --match {match}`"
            )
        return cls(credentials, access_rules(match, robots))

    @classmethod
    def of_any_keys(cls, credentials: HostCredentials, name: str) -> Self:
        """The protection of a replay of this name whose keys are those of no match: each account may receive them.

        Raises:
            TouchlineError: the credentials are for a match of another name.
        """
        protection = cls.of(credentials, name, {side: [] for side in Side})
        return replace(protection, rules=with_any_keys(dict(protection.rules)))

    @classmethod
    def from_file(cls, path: Path | None, config: MatchConfig) -> Self | None:
        """The protection of a match by the host's file; None without a file.

        Raises:
            TouchlineError: the file cannot be read, or is for another match.
        """
        if path is None:
            return None
        return cls.of(read_host_credentials(path), config.name, robots_of(config))


def robots_of(config: MatchConfig) -> Robots:
    """The robots that each side may play: the match's, and ones with usual names that a scene may add later.

    Access rules cannot change during a match. A robot of another name that is added later has no agent.
    """
    robots = {side: config.robots(side) for side in Side}
    taken = {name for names in robots.values() for name in names}
    usual = {side: [f"{side.value}{number}" for number in range(1, MAX_ROBOTS + 1)] for side in Side}
    return {side: [*robots[side], *(name for name in usual[side] if name not in taken)] for side in Side}
