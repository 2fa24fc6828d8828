"""What the clients of a host without credentials may do: what any account may, and nothing on another key.

Such a host does not know who a client is. It still refuses what no client has a reason for: publishing as the host,
answering in its place, keys with wildcards, and keys of no topic.
"""

from typing import Any

from runtime.access.access_rules import access_rules, rule
from runtime.access.rights import Robots
from schemas.tokens import PresenceKind
from schemas.topics import ALIVE, CLAIM, key_prefix

_ANYBODY = "anybody"


def open_access(match: str, robots: Robots) -> dict[str, Any]:
    """The `access_control` section of a host without credentials, for a match with these robots."""
    section, prefix = access_rules(match, robots), key_prefix(match)
    claims, sessions = [prefix + CLAIM.key], [prefix + ALIVE.fill(kind=PresenceKind.SESSION)]
    rules = [
        *section["rules"],
        rule(_ANYBODY, "claims a robot", "ingress", ("query",), claims),
        rule(_ANYBODY, "receives the reply to a claim", "egress", ("reply",), claims),
        rule(_ANYBODY, "knows who decides claims", "egress", ("declare_queryable",), claims),
        rule(_ANYBODY, "declares a session", "ingress", ("liveliness_token",), sessions),
    ]
    policies = [{"rules": [one["id"] for one in rules], "subjects": [_ANYBODY]}]
    return section | {"rules": rules, "subjects": [{"id": _ANYBODY}], "policies": policies}
