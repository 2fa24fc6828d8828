"""A coach program that uses Python's standard library only: it exchanges JSON datagrams with the coach gateway.

    touchline match --udp 28090          # prints the file of the tokens
    python examples/udp_coach.py --port 28090 --token TOKEN-OF-CYAN

It orders its team to hold, to play, and to perform a test: one robot drives to a point. After each order it prints
which robots have acknowledged it, and at the end what the robots believe. Every datagram is numbered, and is sent again
until it is answered.
"""

import argparse
import json
import socket
import sys
import time


class Coach:
    """One session with the gateway."""

    def __init__(self, host: str, port: int, token: str) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect((host, port))
        self._sequence = 0
        self._session = ""
        self.frame: dict = {}
        """The newest frame."""
        self.beliefs: dict = {}
        """Robot → its newest radio message."""
        self.events: list = []
        answer = self.ask("hello", token=token, name="example")
        if not answer["accepted"]:
            raise SystemExit(f"the gateway refuses: {answer['reason']}")
        self._session = answer["session"]
        self.role = answer["role"]

    def ask(self, kind: str, **fields) -> dict:
        """Send a datagram until it is answered."""
        self._sequence += 1
        request = {"kind": kind, "sequence": self._sequence, **fields}
        if self._session:
            request["session"] = self._session
        for _ in range(20):
            try:
                self._socket.send(json.dumps(request).encode())
            except ConnectionRefusedError:
                time.sleep(0.1)  # the gateway is not listening yet
                continue
            answer = self.listen(0.5, until=lambda one: one["kind"] == "ack" and one["sequence"] == request["sequence"])
            if answer is not None:
                return answer
        raise SystemExit("the gateway does not answer")

    def listen(self, seconds: float, until=None):
        """Receive datagrams for some seconds, or until the expected one, which is returned."""
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0:
            self._socket.settimeout(left)
            try:
                datagram = json.loads(self._socket.recv(65536))
            except (TimeoutError, ConnectionRefusedError):
                return None
            self._handle(datagram)
            if until is not None and until(datagram):
                return datagram
        return None

    def _handle(self, datagram: dict) -> None:
        if datagram["kind"] == "frame":
            self.frame = datagram
        elif datagram["kind"] == "belief":
            self.beliefs[datagram["belief"]["robot"]] = datagram["belief"]["radio"]
        elif datagram["kind"] == "event":
            self.events.append(datagram["event"]["text"])
        elif datagram["kind"] == "bye":
            raise SystemExit(f"the session has ended: {datagram['reason']}")

    def order(self, **order) -> None:
        """Send an order and wait until every robot has acknowledged it."""
        answer = self.ask("order", order=order)
        text = ", ".join(f"{key} {value}" for key, value in order.items())
        if not answer["accepted"]:
            print(f"refused: {text}: {answer['reason']}")
            return
        missing = answer["missing"]
        deadline = time.monotonic() + 10
        while missing and time.monotonic() < deadline:
            self.listen(0.2, until=lambda one: one["kind"] == "frame")
            self.ask("alive")
            standing = self.frame.get("orders", {}).get(self.role)
            if standing and standing["order"] == answer["order"]:
                missing = [robot for robot, has in standing["acknowledged"].items() if not has]
        print(f"order {text}: {'not yet by ' + ', '.join(missing) if missing else 'acknowledged by all'}")

    def leave(self) -> None:
        """End the session."""
        self.ask("bye")
        self._socket.close()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=28090)
    parser.add_argument("--token", required=True, help="the token of cyan's or magenta's coach")
    parser.add_argument("--seconds", type=float, default=3.0, help="how long to watch at the end")
    options = parser.parse_args()
    coach = Coach(options.host, options.port, options.token)
    print(f"coach of {coach.role}")
    coach.order(mode="hold")
    coach.order(mode="play", max_speed=2.0)
    answer = coach.ask("match_mode", mode="our_corner")
    print(f"a corner for us: {'accepted' if answer['accepted'] else answer['reason']}")
    coach.order(mode="test", test="move", robot_a=f"{coach.role}2", point_a={"x": -2.0, "y": 1.0}, angle_a=0.0)
    deadline = time.monotonic() + options.seconds
    while time.monotonic() < deadline:
        coach.listen(0.5)
        coach.ask("alive")
    for robot, radio in sorted(coach.beliefs.items()):
        place = radio.get("self")
        where = f"at {place['x']:.2f}, {place['y']:.2f}" if place else "reports no position"
        print(f"{robot} {where}, {radio.get('intention') or radio.get('role') or 'reports no intention'}")
    print(f"{len(coach.events)} events, the match mode is {coach.frame['match_mode'][coach.role]}")
    coach.order(mode="play")
    coach.leave()
    return 0


if __name__ == "__main__":
    sys.exit(main())
