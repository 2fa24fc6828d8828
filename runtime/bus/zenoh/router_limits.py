"""Limits of the host's router, for each link: sizes by the topic table, rates by key, memory and connections.

Zenoh drops what is over a limit before any Python code runs. A rate is a least time between two messages, and a rule
holds for all its keys together: each robot's commands therefore have a rule of their own, or robots of one program that
answer in the same moment would lose commands. If several rules match a key, it is undefined which one applies: no two
of these match the same key. Keys that no rule matches are refused by the router's access rules.
"""

from collections.abc import Iterable, Mapping
from itertools import product
from typing import Any

from runtime.process.timing import LEASE_S
from schemas.side import Side
from schemas.topic import Delivery, Party, Topic
from schemas.topics import COMMAND, TOPICS, key_prefix

_ROBOT_RATE = 200_000.0
"""Most commands a second of one robot. Of two messages that are closer than this period the second is dropped: at a
longer period commands are lost that arrive in one packet after a stall, and without a rule a flood stops the match."""
_KEY_RATE = 1000.0
"""Most messages a second of one link on each other key."""
_QUERY_RATE = 500.0
"""Most queries a second of one link to one service."""
_HISTORY_RATE = 200.0
"""Most requests a second of one link for the history of one topic."""
_CACHES = "@adv/**"
"""Below the key of a `recovered` topic: the caches of its publishers."""
_LEAST_SIZE = 16_384
"""A payload that is longer than its message may be passes up to this size, so that the host can report it."""
_MAX_MESSAGE_BYTES = 4 * 2**20
"""Most bytes of a message in fragments, which the router has to keep until the last fragment arrives."""
_MAX_CONNECTIONS = 256
"""Most connections: a match has at most 22 robots, and some dozen pages, recorders and watchers."""
_MAX_PENDING = 64
"""Most connections that have not finished their handshake."""


def router_limits(match: str, robots: Iterable[str]) -> dict[str, Any]:
    """Settings of the router of a match with these robots."""
    prefix = key_prefix(match)
    return {
        "transport/unicast/max_sessions": _MAX_CONNECTIONS,
        "transport/unicast/accept_pending": _MAX_PENDING,
        "transport/unicast/accept_timeout": round(LEASE_S * 1000),
        "transport/link/rx/max_message_size": _MAX_MESSAGE_BYTES,
        "low_pass_filter": _sizes(prefix),
        "downsampling": _rates(prefix, list(robots)),
    }


def _sizes(prefix: str) -> list[dict[str, Any]]:
    """Largest payloads that clients may send, from the topic table."""
    limits: dict[int, list[str]] = {}
    for topic in _sent_by_clients():
        limits.setdefault(max(_LEAST_SIZE, _size_of(topic)), []).append(prefix + topic.fill())
    largest = max(_size_of(topic, reply=True) for topic in TOPICS.values())
    rules = [
        _size_rule(f"at most {size} bytes", ["put", "delete", "query"], keys, size) for size, keys in limits.items()
    ]
    return [*rules, _size_rule("replies", ["reply"], ["**"], largest)]


def _size_rule(name: str, messages: list[str], keys: list[str], size: int) -> dict[str, Any]:
    return {"id": name, "flows": ["ingress"], "messages": messages, "key_exprs": keys, "size_limit": size}


def _size_of(topic: Topic, *, reply: bool = False) -> int:
    """Most bytes of a message with its attachment, a stamp."""
    kind = topic.reply if reply else topic.message
    return kind.max_bytes + 64 if kind is not None else 0


def _rates(prefix: str, robots: list[str]) -> list[dict[str, Any]]:
    puts: dict[str, float] = {}
    queries: dict[str, float] = {}
    for topic in _sent_by_clients():
        rate = _ROBOT_RATE if topic.key == COMMAND.key else _KEY_RATE
        is_query = topic.delivery is Delivery.QUERY
        for key in _filled(topic, robots):
            (queries if is_query else puts)[prefix + key] = _QUERY_RATE if is_query else rate
    for topic in TOPICS.values():
        if topic.delivery is Delivery.RECOVERED:
            queries |= {f"{prefix}{key}/{_CACHES}": _HISTORY_RATE for key in _filled(topic, robots)}
    return [_rate_rule("messages", ["put", "delete"], puts), _rate_rule("queries", ["query"], queries)]


def _filled(topic: Topic, robots: list[str]) -> list[str]:
    """The keys of a topic for each robot and each side, none of which includes another."""
    values = {"robot": robots, "side": [side.value for side in Side]}
    named = [name for name in topic.chunks if name in values]
    choices = product(*(values[name] for name in named))
    return [topic.fill(**dict(zip(named, choice, strict=True))) for choice in choices]


def _rate_rule(name: str, messages: list[str], rates: Mapping[str, float]) -> dict[str, Any]:
    rules = [{"key_expr": key, "freq": rate} for key, rate in rates.items()]
    return {"id": name, "flows": ["ingress"], "messages": messages, "rules": rules}


def _sent_by_clients() -> list[Topic]:
    """Topics whose messages or queries come from clients."""
    return [topic for topic in TOPICS.values() if topic.writer is not Party.HOST and topic.message is not None]
