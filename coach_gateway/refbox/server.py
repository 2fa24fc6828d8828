"""Our referee in place of the league's box: sends its commands to team software, and receives world states from it.

Each command goes to all base stations, with the address of the team that it is for; WELCOME has each one's own address.
Base stations of the years before 2020 read single characters instead, by their port or by their hello; they get no
addresses and no robots' numbers. A base station that does not read is dropped before much waits for it; none waits for
another.
"""

import asyncio
import contextlib
import socket
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from coach_gateway.match.live import LiveMatch
from coach_gateway.ports import LOOPBACK, bound_socket
from coach_gateway.refbox import DEFAULT_PORT, characters, commands
from coach_gateway.refbox.call_generator import CallGenerator
from coach_gateway.refbox.commands import BoxCommand
from coach_gateway.refbox.framing import BoxProtocol, Framer
from coach_gateway.refbox.identity import Identity, UnknownTeamError, identify, targets
from coach_gateway.refbox.team_world_state import TeamWorldState
from schemas.league.calls import Call
from schemas.league.robot_numbers import numbers_of
from schemas.league.signals import BY_NAME, START, STOP
from schemas.messages.game import GameState
from schemas.side import Side

MOST = 16
"""Base stations at the same time. A further one replaces one that has not identified itself, or is turned away."""
UNREAD = 65_536
"""Bytes that may wait for a base station that does not read, about a thousand commands. Chosen here."""
_SILENCE_S = 1.0
"""s of wall time after which a base station that has not identified itself is welcomed without an address: some
software waits for the welcome before it sends anything."""
_WELCOME = BY_NAME["WELCOME"]


@dataclass(frozen=True, slots=True)
class ServerAddress:
    """Where to listen; base stations on the port of one side belong to that side."""

    port: int = DEFAULT_PORT
    side: Side | None = None
    host: str = LOOPBACK
    protocol: BoxProtocol = BoxProtocol.JSON
    """Protocol of the commands that are sent there."""


@dataclass(eq=False)
class _Peer:
    """One base station."""

    writer: asyncio.StreamWriter
    name: str
    side: Side | None = None
    protocol: BoxProtocol = BoxProtocol.JSON
    """Protocol of the commands that are sent to it; its own messages are JSON in any case."""
    framer: Framer = field(default_factory=lambda: Framer(BoxProtocol.JSON))


class RefBoxServer:
    """Serves all base stations that connect."""

    def __init__(
        self,
        live: LiveMatch,
        server_addresses: Sequence[ServerAddress],
        log: Callable[[str], None],
        of_token: Callable[[str], Side | None] = lambda _token: None,
        addresses: Mapping[Side, str] | None = None,
        bound: Sequence[socket.socket] = (),
    ) -> None:
        """Serves on these server addresses.

        Args:
            live: the match.
            server_addresses: where to listen.
            log: called with lines for people.
            of_token: the side whose coach has a token.
            addresses: what the sides are called in commands, unless a base station's hello asks for another address;
                by default their names.
            bound: the sockets of the server addresses where they are bound already.
        """
        self._live = live
        self._server_addresses, self._bound = server_addresses, bound
        self._log = log
        self._of_token = of_token
        self._call_generator = CallGenerator()
        self._addresses: dict[Side, str] = dict(addresses or {})
        self._peers: list[_Peer] = []
        self.ports: list[int] = []
        """Ports that it listens on, once it does."""
        self.team_states: dict[Side, TeamWorldState] = {side: TeamWorldState() for side in Side}
        """The world states of each team."""
        live.on_state(self._send_calls)

    async def serve(self, stop: asyncio.Event) -> None:
        """Listen until `stop` is set.

        Raises:
            TouchlineError: a port is taken.
        """
        async with contextlib.AsyncExitStack() as stack:
            sockets = self._bound or [
                bound_socket("--refbox-server", address.host, address.port, socket.SOCK_STREAM)
                for address in self._server_addresses
            ]
            for address, bound in zip(self._server_addresses, sockets, strict=True):
                server = await stack.enter_async_context(await self._open(address, bound))
                self.ports.append(server.sockets[0].getsockname()[1])
                whom = f"{address.side}'s base station" if address.side is not None else "base stations"
                how = ", in characters" if address.protocol is BoxProtocol.CHARACTERS else ""
                self._log(f"referee box for {whom} on {address.host}:{self.ports[-1]}{how}")
            await stop.wait()
            for peer in self._peers:
                peer.writer.transport.abort()

    async def _open(self, address: ServerAddress, bound: socket.socket) -> asyncio.Server:
        return await asyncio.start_server(lambda r, w: self._run_connection(r, w, address), sock=bound)

    def send(self, calls: Sequence[Call]) -> None:
        """Send these commands to all base stations."""
        if calls and self._live.setup is not None:
            called = self._targets()
            numbers = numbers_of(self._live.sides)
            json_text = b"".join(
                commands.write(
                    BoxCommand(call.signal, called[call.side] if call.side else "", numbers.get(call.robot or ""))
                )
                for call in calls
            )
            text = {
                BoxProtocol.JSON: json_text,
                BoxProtocol.CHARACTERS: b"".join(characters.write(call.signal, call.side) for call in calls),
            }
            for peer in tuple(self._peers):
                self._send(peer, text[peer.protocol])

    def _send_calls(self, state: GameState) -> None:
        self.send(self._call_generator.next_calls(state, self._live.sides))

    def _targets(self) -> dict[Side, str]:
        return targets(self._names(), self._addresses)

    def _names(self) -> dict[Side, str]:
        setup = self._live.setup
        return {side: setup.teams[side].name if setup is not None else side.value for side in Side}

    async def _run_connection(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, address: ServerAddress
    ) -> None:
        """Serve one connection from its beginning to its end."""
        host, port = (writer.get_extra_info("peername") or ("gone", 0))[:2]
        peer = _Peer(writer, f"{host}:{port}", protocol=address.protocol)
        if len(self._peers) >= MOST and not self._make_room():
            self._log(f"base station {peer.name} turned away: {MOST} are connected")
            writer.transport.abort()
            return
        self._peers.append(peer)
        late = asyncio.get_running_loop().call_later(_SILENCE_S, self._welcome_unidentified, peer)
        try:
            if address.side is not None:
                self._settle(peer, Identity(address.side))
            while data := await reader.read(16_384):
                for message in peer.framer.feed(data):
                    if isinstance(message, dict):
                        self._read_object(peer, message)
        except (OSError, UnknownTeamError) as error:
            self._log(f"base station {peer.name}: {error}")
        finally:
            late.cancel()
            self._forget(peer)

    def _make_room(self) -> bool:
        """Drop the first base station that has not identified itself; returns whether there was one."""
        unidentified = next((peer for peer in self._peers if peer.side is None), None)
        if unidentified is None:
            return False
        self._log(f"base station {unidentified.name} is dropped: it has no identity, and {MOST} are connected")
        self._drop(unidentified)
        return True

    def _read_object(self, peer: _Peer, message: dict[str, Any]) -> None:
        """Handle one object of a base station: its identity, or its world state.

        Raises:
            UnknownTeamError: it identifies itself as an unknown team.
        """
        if peer.side is None or message.get("type") == "hello":
            identity = identify(message, self._names(), self._of_token)
            if identity is not None:
                self._settle(peer, identity)
        if peer.side is not None and message.get("type") != "hello":
            self.team_states[peer.side].update(message, self._live.now)

    def _settle(self, peer: _Peer, identity: Identity) -> None:
        """Note the identity of a base station; it replaces an earlier one of its team, and is sent its address."""
        for other in [other for other in self._peers if other is not peer and other.side is identity.side]:
            self._log(f"{identity.side}'s base station {other.name} is replaced by {peer.name}")
            self._drop(other)
        protocol = identity.protocol or peer.protocol
        changed = (peer.side, peer.protocol) != (identity.side, protocol)
        peer.side, peer.protocol = identity.side, protocol
        if identity.address is not None:
            changed = changed or self._addresses.get(peer.side) != identity.address
            self._addresses[peer.side] = identity.address
        if changed:
            self._log(f"{peer.side}'s base station is {peer.name}")
            self._welcome(peer)

    def _welcome_unidentified(self, peer: _Peer) -> None:
        if peer.side is None:
            self._welcome(peer)

    def _welcome(self, peer: _Peer) -> None:
        """Send its own address, and whether the game runs: a team that connects late must know of a stop."""
        state = self._live.state
        running = START if state is not None and state.running else STOP
        if peer.protocol is BoxProtocol.CHARACTERS:
            self._send(peer, characters.write(_WELCOME) + characters.write(running))
            return
        address = self._targets()[peer.side] if peer.side is not None else ""
        self._send(peer, commands.write(BoxCommand(_WELCOME, address)) + commands.write(BoxCommand(running)))

    def _send(self, peer: _Peer, text: bytes) -> None:
        transport = peer.writer.transport
        if not text or transport.is_closing():
            return
        peer.writer.write(text)
        if transport.get_write_buffer_size() > UNREAD:
            self._log(f"base station {peer.name} does not read and is dropped")
            self._drop(peer)

    def _drop(self, peer: _Peer) -> None:
        if peer in self._peers:
            self._peers.remove(peer)
        peer.writer.transport.abort()

    def _forget(self, peer: _Peer) -> None:
        self._drop(peer)
        who = f"{peer.side}'s base station {peer.name}" if peer.side is not None else f"base station {peer.name}"
        summary = f"; {self.team_states[peer.side].summary()}" if peer.side is not None else ""
        odd = f"; {peer.framer.garbage} pieces that were not a message" if peer.framer.garbage else ""
        self._log(f"{who} is gone{summary}{odd}")
