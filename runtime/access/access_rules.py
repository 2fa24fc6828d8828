"""Zenoh's access control for one match: default deny, and for each account the rules that its rights come to. Pure.

Flows are seen from the host: `ingress` is what an account sends, `egress` what it is sent. A rule matches if its keys
include the key of the message, so that a subscription or a publication with wildcards needs a rule of at least its
extent.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from runtime.access.accounts import ACCOUNTS, Account
from runtime.access.rights import Rights, Robots
from schemas.tokens import PresenceKind
from schemas.topics import ALIVE, key_prefix

CACHE = "/@adv/**"
"""Below the key of a recovered topic: its publisher's cache, heartbeats and liveliness token. Wildcards do not match
chunks that begin with @."""


def access_rules(match: str, robots: Robots) -> dict[str, Any]:
    """The `access_control` section of a host's Zenoh configuration."""
    rules = {account: _rules_of(match, Rights(account, robots)) for account in ACCOUNTS}
    return access_section(rules)


def access_section(rules: Mapping[Account, Sequence[dict[str, Any]]]) -> dict[str, Any]:
    """An `access_control` section that allows each account what its rules say, and nothing else."""
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": [one for of_account in rules.values() for one in of_account],
        "subjects": [{"id": account.value, "usernames": [account.value]} for account in ACCOUNTS],
        "policies": [
            {"rules": [one["id"] for one in of_account], "subjects": [account.value]}
            for account, of_account in rules.items()
        ],
    }


def with_any_keys(section: dict[str, Any]) -> dict[str, Any]:
    """An `access_control` section with which each account may also receive what is published on any key."""
    rules = [
        rule("everybody", "subscribes", "ingress", ("declare_subscriber",), ["**"]),
        rule("everybody", "receives", "egress", ("put",), ["**"]),
    ]
    policy = {"rules": [one["id"] for one in rules], "subjects": [account.value for account in ACCOUNTS]}
    return section | {"rules": [*section["rules"], *rules], "policies": [*section["policies"], policy]}


def _rules_of(match: str, rights: Rights) -> list[dict[str, Any]]:
    caches = [key + CACHE for key in rights.recovers]
    all_tokens = ALIVE.fill()
    rows = (
        ("publishes", "ingress", ("put",), rights.publishes),
        # Without it a client's publisher sends nothing. Clients learn that keys are subscribed to, and no message.
        ("knows subscribers", "egress", ("declare_subscriber",), rights.written_patterns),
        ("subscribes", "ingress", ("declare_subscriber",), [*rights.subscribes, *caches]),
        ("receives", "egress", ("put",), [*rights.subscribes, *caches]),
        ("queries", "ingress", ("query",), [*rights.queries, *caches]),
        ("receives replies", "egress", ("reply", "declare_queryable"), [*rights.queries, *caches]),
        ("receives earlier messages", "egress", ("reply",), rights.recovers),  # a cache replies with the message's key
        ("serves", "ingress", ("reply", "declare_queryable"), rights.serves),
        ("receives queries", "egress", ("query",), rights.serves),
        ("declares tokens", "ingress", ("liveliness_token",), rights.declares),
        ("watches tokens", "ingress", ("declare_liveliness_subscriber", "liveliness_query"), [all_tokens, *caches]),
        ("sees tokens", "egress", ("liveliness_token",), [*rights.sees, *caches]),
    )
    account, prefix = rights.account, key_prefix(match)
    rules = [rule(account, name, flow, messages, [prefix + key for key in keys]) for name, flow, messages, keys in rows]
    any_host = key_prefix("*") + ALIVE.fill(kind=PresenceKind.HOST)
    rules.append(rule(account, "finds the match", "ingress", ("liveliness_query",), [any_host]))
    return [one for one in rules if one["key_exprs"]]


def rule(subject: str, name: str, flow: str, messages: tuple[str, ...], keys: list[str]) -> dict[str, Any]:
    """One rule, which allows a subject these messages on these keys."""
    return {
        "id": f"{subject} {name}",
        "permission": "allow",
        "flows": [flow],
        "messages": list(messages),
        "key_exprs": keys,
    }
