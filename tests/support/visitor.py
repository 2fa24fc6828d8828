"""A page without a browser: a real WebSocket to the gateway."""

import itertools
import json
import time
from contextlib import suppress
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from runtime.bus.contract import Subscription
from support.page_gateway import SOON, TOKENS


class Visitor:
    """One open page."""

    def __init__(
        self, origin: str, token: str = "", claims: str | None = None, patience: float = SOON, **more: Any
    ) -> None:
        """`claims` is the origin that it sends, by default its own, none if empty; `patience` is in s."""
        self.token = token
        self.welcome: dict[str, Any] = {}
        """The newest one that `hear_what_is_played` has met."""
        self._patience = patience
        self._numbers = itertools.count(1)
        opening = connect(
            f"{origin.replace('http', 'ws')}/ws",
            origin=origin if claims is None else claims or None,  # type: ignore[arg-type]
            open_timeout=patience,
            max_size=None,
            **more,
        )
        self.socket: ClientConnection = opening.__enter__()

    def hear(self, kind: str = "", **fields: Any) -> dict[str, Any]:
        """The next message, of a kind and with these fields where they are named; others are passed over.

        So are signs of life, which come once a second between all else.
        """
        deadline = time.monotonic() + self._patience
        while True:
            message: dict[str, Any] = json.loads(self.socket.recv(max(0.0, deadline - time.monotonic())))
            of_kind = message["kind"] == kind if kind else message["kind"] != "alive"
            if of_kind and all(message[name] == value for name, value in fields.items()):
                return message

    def hear_what_is_played(self) -> dict[str, Any]:
        """The first welcome with a setup: before it, requests are refused."""
        self.welcome = self.hear("welcome")
        while self.welcome["setup"] is None:
            self.welcome = self.hear("welcome")
        return self.welcome

    def ask(self, deed: str, token: str | None = None, **content: Any) -> dict[str, Any]:
        """What is answered to a query."""
        number = self.say(deed, token, **content)
        return self.hear("reply", id=number)

    def say(self, deed: str, token: str | None = None, **content: Any) -> int:
        """Ask without waiting for the answer; returns the number of the query."""
        number = next(self._numbers)
        self.send({"id": number, "token": self.token if token is None else token, "deed": deed, **content})
        return number

    def send(self, content: Any) -> None:
        self.socket.send(content if isinstance(content, str | bytes) else json.dumps(content))

    def enter(self, role: str) -> dict[str, Any]:
        """Take a role, with its token; returns the welcome."""
        self.token = TOKENS[role]
        assert self.ask("token")["accepted"]
        return self.hear("welcome", role=role)

    def close(self) -> None:
        with suppress(ConnectionClosed):
            self.socket.close()


def wait_for(reader: Subscription) -> Any:
    """The next message that a host is sent."""
    received = reader.receive(SOON)
    assert received is not None
    return received.message()
