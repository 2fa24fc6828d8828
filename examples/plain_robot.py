"""A robot that uses nothing of Touchline but its protocol: Zenoh, JSON and docs/protocol.md.

It drives to the ball and kicks it toward the goal. A program in any other language takes the same steps.
"""

import base64
import json
import math
import os
import secrets
import struct
import time
from pathlib import Path
from typing import Any

import zenoh

ROOT = f"touchline/{os.environ['TOUCHLINE_MATCH']}"
ROBOT = os.environ["TOUCHLINE_ROBOT"]
SETTINGS = {
    "mode": "client",
    "connect/endpoints": [os.environ["TOUCHLINE_CONNECT"]],
    "connect/timeout_ms": 10_000,
    "connect/retry": {"period_init_ms": 20, "period_max_ms": 100, "period_increase_factor": 1.5},
    "scouting/multicast/enabled": False,
    "scouting/gossip/enabled": False,
    "transport/shared_memory/enabled": False,
}
CREDENTIALS: dict[str, Any] = (
    json.loads(Path(os.environ["TOUCHLINE_CREDENTIALS"]).read_text()) if "TOUCHLINE_CREDENTIALS" in os.environ else {}
)
if CREDENTIALS:
    SETTINGS["transport/auth/usrpwd/user"] = CREDENTIALS["user"]
    SETTINGS["transport/auth/usrpwd/password"] = CREDENTIALS["password"]
if CREDENTIALS.get("root_certificate"):
    root = base64.b64encode(CREDENTIALS["root_certificate"].encode()).decode()
    SETTINGS["transport/link/tls/root_ca_certificate_base64"] = root
STAMP = struct.Struct("<QQq")
TOP_SPEED = 2.0
"""m/s."""


def answer(sight: dict[str, Any], goal_x: float) -> dict[str, Any]:
    """The command for a sight: drive to the ball; with the ball, turn to the goal and kick. `goal_x` in m."""
    me, holding = sight["self"], sight["holding"]
    ball = sight["ball"] or sight["game"]["spot"]  # before it is seen: where the referee has placed it
    command = {"version": "2.0", "answers_tick": sight["tick"], "dribble": True}
    if ball is None or not sight["game"]["running"] or sight["game"]["phase"].startswith("their_"):
        return command
    x, y = (goal_x, 0.0) if holding else (ball["x"], ball["y"])
    bearing = math.remainder(math.atan2(y - me["y"], x - me["x"]) - me["heading"], math.tau)
    speed = 0.0 if holding else min(TOP_SPEED, 0.3 + math.dist((x, y), (me["x"], me["y"])))
    command["drive"] = {"vx": speed * math.cos(bearing), "vy": speed * math.sin(bearing), "omega": 3.0 * bearing}
    if holding and abs(bearing) < 0.05:
        command["kick"] = {"mode": "ground", "speed": 8.0}
    return command


def query(session: zenoh.Session, key: str, request: dict[str, Any]) -> dict[str, Any]:
    """The host's reply to a request; queries the host until it replies."""
    while True:
        payload = json.dumps({"version": "2.0", **request})
        for reply in session.get(f"{ROOT}/{key}", payload=payload, timeout=4.0):
            if reply.ok is not None:
                content: dict[str, Any] = json.loads(reply.ok.payload.to_bytes())
                return content
        time.sleep(0.1)


def claim(session: zenoh.Session, name: str) -> None:
    """Claim the robot for the session of this name, whose liveliness token exists."""
    secret = os.environ.get("TOUCHLINE_LAUNCH_TOKEN")
    reply = query(session, f"robot/{ROBOT}/claim", {"robot": ROBOT, "session": name, "launch_token": secret})
    if not reply["accepted"]:
        raise SystemExit(f"{ROBOT}: refused by the host: {reply['reason']}")


def main() -> None:
    """Join the match and answer every sight."""
    config = zenoh.Config()
    for key, value in SETTINGS.items():
        config.insert_json5(key, json.dumps(value))
    with zenoh.open(config) as session:
        goal_x = query(session, "host/setup", {})["pitch"]["length"] / 2
        sights = session.declare_subscriber(f"{ROOT}/robot/{ROBOT}/sight", zenoh.handlers.RingChannel(1))
        commands = session.declare_publisher(
            f"{ROOT}/robot/{ROBOT}/command",
            encoding=zenoh.Encoding.APPLICATION_JSON,
            congestion_control=zenoh.CongestionControl.DROP,
        )
        name = f"{CREDENTIALS.get('user', 's')}_{secrets.token_hex(12)}"
        with session.liveliness().declare_token(f"{ROOT}/alive/session/{name}"):
            claim(session, name)
            for sequence, sample in enumerate(sights):
                sight = json.loads(sample.payload.to_bytes())
                stamp = STAMP.pack(sequence, time.time_ns(), round(sight["time"] * 1e9))
                commands.put(json.dumps(answer(sight, goal_x)), attachment=stamp)


if __name__ == "__main__":
    main()
