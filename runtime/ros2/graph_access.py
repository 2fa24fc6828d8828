"""What the nodes of each account may do in a graph, as Zenoh's access control of its router. Pure.

A team's nodes have all topics, services and tokens below the names of their own robots: they drive these and talk with
each other there. Those of the operator have the services by which nodes control the match. Clock and transforms are
read by all accounts. Everything else is denied.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from runtime.access.access_rules import CACHE, access_section, rule
from runtime.access.accounts import ACCOUNTS, Account
from runtime.access.rights import Robots
from runtime.ros2.graph_names import CONTROL, TOKENS, Kind

_FOR_ALL = ("clock", "tf", "tf_static")
"""Topics that everybody reads; only the bridge publishes them."""
_KEYS = "declare_subscriber", "declare_queryable"
_SENT = "put", "query", "reply"


def graph_access(domain: int, robots: Robots) -> Mapping[str, Any]:
    """The `access_control` of the router of a graph; `robots` has those of each side."""
    return access_section({account: _rules_of(account, domain, robots) for account in ACCOUNTS})


def _rules_of(account: Account, domain: int, robots: Robots) -> list[dict[str, Any]]:
    own: Sequence[str] = (CONTROL,) if account is Account.OPERATOR else ()
    if account in (Account.CYAN, Account.MAGENTA) and account.side is not None:
        own = robots[account.side]
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
