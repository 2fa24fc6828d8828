"""The names under which referees hold the seat of a match: a gateway's, a terminal's, and a league's box's."""

import getpass
import platform
import re
from hashlib import blake2b

_LONGEST = 32
"""Characters of a name, as `schemas.wire.message.Name` demands."""


def gateway_name(connection: str) -> str:
    """The name of all people who officiate through one gateway: they share its token, and so the seat.

    `connection` is the name of the gateway's connection to the bus.
    """
    return f"gateway_{connection}"[:_LONGEST]


def terminal_name() -> str:
    """The name of the commands of one user on one machine; the recording gets a digest of both, and neither name."""
    try:
        user = getpass.getuser()
    except (KeyError, OSError):  # a user without an entry in the system's list of users
        user = "unknown"
    return f"terminal_{_digest(f'{user}@{platform.node()}')}"


def box_name(host: str, port: int) -> str:
    """The name of a league's box: two base stations that are connected to one box are one referee."""
    name = re.sub(r"[^a-z0-9]", "_", f"box_{host.lower()}_{port}")
    return name if len(name) <= _LONGEST else f"box_{_digest(name)}"


def _digest(text: str) -> str:
    return blake2b(text.encode(), digest_size=4).hexdigest()
