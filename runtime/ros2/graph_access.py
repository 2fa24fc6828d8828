"""What the nodes of each account may do in a graph, as Zenoh's access control of its router. Pure.

It follows from the topic table of the match. Who may publish a robot's commands has all topics, services and tokens
below the name of that robot: a team's nodes drive it and talk with each other there. Who may pause the match has the
services by which nodes control it. Clock and transforms are read by all accounts. Everything else is denied.
"""

from collections.abc import Mapping
from typing import Any

from runtime.access.access_rules import CACHE, access_section, rule
from runtime.access.accounts import ACCOUNTS, Account
from runtime.access.rights import Rights, Robots
from runtime.ros2.graph_names import CONTROL, TOKENS, Kind
from schemas.topics import COMMAND, PACE

_FOR_ALL = ("clock", "tf", "tf_static")
"""Topics that everybody reads; only the bridge publishes them."""
_KEYS = "declare_subscriber", "declare_queryable"
_SENT = "put", "query", "reply"


def graph_access(domain: int, robots: Robots) -> Mapping[str, Any]:
    """The `access_control` of the router of a graph; `robots` has those of each side."""
    return access_section({account: _rules_of(account, domain, robots) for account in ACCOUNTS})


def _rules_of(account: Account, domain: int, robots: Robots) -> list[dict[str, Any]]:
    rights = Rights(account, robots)
    known = [robot for side in robots.values() for robot in side]
    own = [robot for robot in known if COMMAND.fill(robot=robot) in rights.publishes]
    if PACE.fill() in rights.queries:
        own.append(CONTROL)
    keys = [f"{domain}/{robot}/**" for robot in own]
    read = [f"{domain}/{topic}/*/*" for topic in _FOR_ALL]
    read += [key + CACHE for key in read]
    tokens = f"{TOKENS}/{domain}/*/*/*"
    declared = [f"{tokens}/{Kind.NODE}/**"]
    declared += [f"{tokens}/*/*/*/*/%{robot}%$*/**" for robot in own]
    declared += [f"{tokens}/{Kind.SUBSCRIPTION}/*/*/*/%{topic}/**" for topic in _FOR_ALL]
    rows = (
        ("declares", "ingress", _KEYS, [*keys, *read]),
        ("knows", "egress", _KEYS, [*keys, *read]),
        ("sends", "ingress", _SENT, keys),
        ("asks for what was missed", "ingress", ("query",), read),
        ("receives", "egress", _SENT, [*keys, *read]),
        ("declares tokens", "ingress", ("liveliness_token",), [*declared, *read]),
        ("watches tokens", "ingress", ("declare_liveliness_subscriber", "liveliness_query"), [f"{TOKENS}/**", *read]),
        ("sees tokens", "egress", ("liveliness_token",), [f"{TOKENS}/{domain}/**", *read]),
    )
    rules = [rule(account, name, flow, messages, found) for name, flow, messages, found in rows]
    return [one for one in rules if one["key_exprs"]]
