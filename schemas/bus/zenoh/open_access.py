"""What the clients of a host without credentials may do: what any account may, and nothing on another key.

Such a host does not know who a client is. It still refuses what no client has a reason for: publishing as the host,
answering in its place, keys with wildcards, and keys of no topic.
"""

from typing import Any

from schemas.access.access_rules import access_rules
from schemas.access.rights import Robots
from schemas.tokens import PresenceKind
from schemas.topics import ALIVE, CLAIM, key_prefix

_ANYBODY = "anybody"


def open_access(match: str, robots: Robots) -> dict[str, Any]:
    """The `access_control` section of a host without credentials, for a match with these robots."""
    prefix = key_prefix(match)
    extra = [
        _rule("claims a robot", "ingress", "query", prefix + CLAIM.key),
        _rule("receives the reply to a claim", "egress", "reply", prefix + CLAIM.key),
        _rule("knows who decides claims", "egress", "declare_queryable", prefix + CLAIM.key),
        _rule("declares a session", "ingress", "liveliness_token", prefix + ALIVE.fill(kind=PresenceKind.SESSION)),
    ]
    rules = [*access_rules(match, robots)["rules"], *extra]
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": rules,
        "subjects": [{"id": _ANYBODY}],
        "policies": [{"rules": [rule["id"] for rule in rules], "subjects": [_ANYBODY]}],
    }


def _rule(name: str, flow: str, message: str, key: str) -> dict[str, Any]:
    return {
        "id": f"{_ANYBODY} {name}",
        "permission": "allow",
        "flows": [flow],
        "messages": [message],
        "key_exprs": [key],
    }
