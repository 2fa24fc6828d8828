"""The system user that a team's programs run as with `isolate = "user"`."""

import os
import pwd
import stat
from pathlib import Path
from typing import NamedTuple

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side


class TeamUser(NamedTuple):
    """A user of this machine."""

    name: str
    user: int
    group: int

    def can_read(self, path: Path) -> bool:
        """Whether the user may read a file, or list a folder, by the rights of the path; groups are dropped."""
        real = path.resolve()
        return self.can_enter(real.parent) and self._may(real, 0o5 if real.is_dir() else 0o4)

    def can_enter(self, folder: Path) -> bool:
        """Whether the user may use paths in a folder."""
        real = folder.resolve()
        return all(self._may(one, 0o1) for one in (real, *real.parents))

    def _may(self, path: Path, wanted: int) -> bool:
        found = path.stat()
        mode = stat.S_IMODE(found.st_mode)
        shift = 6 if found.st_uid == self.user else 3 if found.st_gid == self.group else 0
        return (mode >> shift) & wanted == wanted


def team_users(config: MatchConfig) -> dict[Side, TeamUser]:
    """The users of the teams that are launched here.

    Raises:
        TouchlineError: this process may not change users, a user does not exist, or the teams share one.
    """
    if os.geteuid() != 0:
        raise TouchlineError(
            "--isolate user starts robots as other users, which only root may; "
            "run the match as root, or use --isolate bubblewrap"
        )
    users = {side: _user(config, side) for side in config.local_sides}
    if len({user.user for user in users.values()}) < len(users):
        name = next(iter(users.values())).name
        raise TouchlineError(f"isolate_users are both {name}; give each team a user of its own")
    return users


def _user(config: MatchConfig, side: Side) -> TeamUser:
    named = config.isolate_users.cyan if side is Side.CYAN else config.isolate_users.magenta
    name = named or os.environ.get(f"TOUCHLINE_USER_{side.name}") or f"touchline-{side.value}"
    try:
        found = pwd.getpwnam(name)
    except KeyError:
        raise TouchlineError(
            f"isolate_users.{side.value} is {name}, which is no user of this machine; "
            f"create it with: useradd --system {name}"
        ) from None
    if found.pw_uid == 0:
        raise TouchlineError(f"isolate_users.{side.value} is {name}, who is root; name a user without rights")
    return TeamUser(name, found.pw_uid, found.pw_gid)
