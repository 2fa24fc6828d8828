"""Sends the audience feed over UDP, every 50 ms, to a list of addresses."""

import asyncio
import json
import socket
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from coach_gateway.match.live import LiveMatch
from coach_gateway.service import pause
from coach_gateway.soccer.refbox.audience import Audience, event
from coach_gateway.soccer.refbox.call_generator import CallGenerator
from coach_gateway.soccer.refbox.own_world_state import own_world_state
from coach_gateway.soccer.refbox.team_world_state import TeamWorldState
from coach_gateway.timing import BOX_PERIOD_S, WORLD_STATE_S
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.side import Side


class AudienceFeed:
    """Sends the feed to a list of addresses."""

    def __init__(
        self,
        live: LiveMatch,
        addresses: Sequence[tuple[str, int]],
        log: Callable[[str], None],
        team_states: Mapping[Side, TeamWorldState] | None = None,
    ) -> None:
        """`team_states` are the world states of base stations, if there are any."""
        self._live = live
        self._addresses = addresses
        self._log = log
        self._team_states = team_states if team_states is not None else {}
        self._targets: list[tuple[Any, ...]] = []
        self._audience = Audience()
        self._call_generator = CallGenerator()
        self._transport: asyncio.DatagramTransport | None = None
        live.on_state(self._send_calls)

    async def serve(self, stop: asyncio.Event) -> None:
        """Send until `stop` is set.

        Raises:
            TouchlineError: nothing can be sent to an address.
        """
        loop = asyncio.get_running_loop()
        try:
            family = (await loop.getaddrinfo(*self._addresses[0], type=socket.SOCK_DGRAM))[0][0]
            for host, port in self._addresses:
                found = await loop.getaddrinfo(host, port, family=family, type=socket.SOCK_DGRAM)
                self._targets.append(found[0][4])
            self._transport, _ = await loop.create_datagram_endpoint(asyncio.DatagramProtocol, family=family)
        except OSError as error:
            raise TouchlineError(f"--audience: nothing can be sent there ({error}); name other addresses") from None
        self._log(f"audience feed to {', '.join(f'{host}:{port}' for host, port in self._addresses)}")
        due = self._live.now
        try:
            while not stop.is_set():
                self._send_state()
                due = max(due + BOX_PERIOD_S, self._live.now)
                await pause(stop, due - self._live.now)
        finally:
            self._transport.close()

    def _send_calls(self, state: GameState) -> None:
        setup = self._live.setup
        numbers = numbers_of(self._live.sides)
        for call in self._call_generator.next_calls(state, self._live.sides):
            if setup is not None:
                self._send(event(call, setup, numbers))

    def _send_state(self) -> None:
        state, setup = self._live.state, self._live.setup
        if state is None or setup is None:
            return
        self._send(self._audience.teams(state, setup, {side: self._world(side) for side in Side}))

    def _world(self, side: Side) -> Mapping[str, Any]:
        live, view = self._live, self._team_states.get(side)
        if view is not None and view.newest is not None and live.now - view.newest_at < WORLD_STATE_S:
            return view.newest
        if live.world is None or live.setup is None:
            return {}
        return own_world_state(side, live.setup, live.sides, live.state, live.world, live.beliefs([side]))

    def _send(self, content: Mapping[str, Any]) -> None:
        """Send an object to all addresses; it fits into a datagram, as do the world states of both teams."""
        datagram = json.dumps(content, separators=(",", ":")).encode() + b"\x00"
        if self._transport is not None and not self._transport.is_closing():
            for address in self._targets:
                self._transport.sendto(datagram, address)
