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
from dataclasses import dataclass
from functools import partial
from typing import Any

from coach_gateway.access.refusals import Refusals
from coach_gateway.match.live import LiveMatch
from coach_gateway.ports import LOOPBACK
from coach_gateway.soccer.refbox import DEFAULT_PORT, commands
from coach_gateway.soccer.refbox.call_generator import CallGenerator
from coach_gateway.soccer.refbox.commands import BoxCommand
from coach_gateway.soccer.refbox.identity import HELLO, Identity, UnknownTeamError, identify, targets
from coach_gateway.soccer.refbox.peers import MOST, Peer, Proof, why_kept
from coach_gateway.soccer.refbox.team_world_state import TeamWorldState
from coach_gateway.timing import CLIENT_S
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.messages.soccer.league.calls import Call
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.messages.soccer.league.signals import BY_NAME, START, STOP
from schemas.side import Side

UNREAD = 65_536
"""Bytes that may wait for a base station that does not read, about a thousand commands. Chosen here."""
_WELCOME = BY_NAME["WELCOME"]


@dataclass(frozen=True, slots=True)
class ServerAddress:
    """Where to listen; base stations on the port of one side belong to that side."""

    port: int = DEFAULT_PORT
    side: Side | None = None
    host: str = LOOPBACK
    protocol: BoxProtocol = BoxProtocol.JSON
    """Protocol of the commands that are sent there."""


class RefBoxServer:
    """Serves all base stations that connect."""

    def __init__(
        self,
        live: LiveMatch,
        server_addresses: Sequence[ServerAddress],
        bound: Sequence[socket.socket],
        log: Callable[[str], None],
        of_token: Callable[[str], Side | None] = lambda _token: None,
        addresses: Mapping[Side, str] | None = None,
    ) -> None:
        """Serves on these server addresses.

        Args:
            live: the match.
            server_addresses: where to listen.
            bound: the socket of each server address.
            log: called with lines for people.
            of_token: the side whose coach has a token.
            addresses: what the sides are called in commands, unless a base station's hello asks for another address;
                by default their names.
        """
        self._live = live
        self._server_addresses, self._bound = server_addresses, bound
        self._log = log
        self._of_token = of_token
        self._call_generator = CallGenerator()
        self._addresses: dict[Side, str] = dict(addresses or {})
        self._peers: list[Peer] = []
        self.refusals = Refusals("referee box", log)
        """Refused connections and messages by kind."""
        self.ports: list[int] = []
        """Ports that it listens on, once it does."""
        self.team_states: dict[Side, TeamWorldState] = {side: TeamWorldState() for side in Side}
        """The world states of each team."""
        live.on_state(self._send_calls)

    async def serve(self, stop: asyncio.Event) -> None:
        """Listen until `stop` is set."""
        async with contextlib.AsyncExitStack() as stack:
            for address, bound in zip(self._server_addresses, self._bound, strict=True):
                serves = partial(self._run_connection, address=address)
                server = await asyncio.start_server(serves, sock=bound, backlog=16)
                await stack.enter_async_context(server)
                self.ports.append(server.sockets[0].getsockname()[1])
                whom = f"{address.side}'s base station" if address.side is not None else "base stations"
                how = ", in characters" if address.protocol is BoxProtocol.CHARACTERS else ""
                self._log(f"referee box for {whom} on {address.host}:{self.ports[-1]}{how}")
            await stop.wait()
            for peer in tuple(self._peers):
                peer.writer.transport.abort()
            self.refusals.log_summary()

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
                BoxProtocol.CHARACTERS: "".join(call.signal.character_for(call.side) for call in calls).encode("ascii"),
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
        peer = Peer(writer, host, port, self._live.now, protocol=address.protocol)
        if len(self._peers) >= MOST and not self._make_room(peer):
            return
        self._peers.append(peer)
        late = asyncio.get_running_loop().call_later(CLIENT_S, self._welcome_unidentified, peer)
        try:
            if address.side is not None:
                self._settle(peer, Identity(address.side), Proof.PORT)
            while data := await reader.read(16_384):
                for message in peer.framer.feed(data):
                    if isinstance(message, dict):
                        self._read_object(peer, message, address.side)
                await asyncio.sleep(0)  # a base station that floods takes turns with everything else
        except OSError as error:
            self._log(f"base station {peer.name}: {error}")
        except UnknownTeamError as error:
            self._refuse(peer, "hello", str(error))
        finally:
            late.cancel()
            self._forget(peer)

    def _make_room(self, newcomer: Peer) -> bool:
        """Drop the oldest base station that has not identified itself; returns whether there was one."""
        unidentified = next((peer for peer in self._peers if peer.side is None), None)
        if unidentified is None:
            self._refuse(newcomer, "connection", f"{MOST} base stations are connected")
            return False
        self._refuse(unidentified, "connection without an identity that made room")
        return True

    def _refuse(self, peer: Peer, kind: str, reason: str = "") -> None:
        """Count a refusal, and close the connection."""
        self.refusals.note(kind, peer.host, reason)
        self._drop(peer)

    def _read_object(self, peer: Peer, message: dict[str, Any], port_of: Side | None) -> None:
        """Handle one object of a base station: its identity, or its world state.

        Raises:
            UnknownTeamError: it identifies itself as an unknown team, or as one that it is not.
        """
        now = peer.heard_at = self._live.now
        is_hello = message.get("type") == HELLO
        if peer.side is None or is_hello:
            identity = identify(message, self._names(), self._of_token)
            if identity is not None:
                proof = Proof.PORT if port_of is not None else Proof.NAME
                if port_of not in (None, identity.side):
                    raise UnknownTeamError(f"this port is for {port_of}'s base station alone")
                self._settle(peer, identity, Proof.TOKEN if is_hello and message.get("token") else proof)
        if peer.side is not None and not is_hello:
            fault = self.team_states[peer.side].update(message, now)
            if fault:
                self.refusals.note("world state that is not passed on", peer.host, fault)

    def _settle(self, peer: Peer, identity: Identity, proof: Proof) -> None:
        """Note the identity of a base station; it replaces an earlier one of its team, and is sent its address.

        Raises:
            UnknownTeamError: the earlier one stays.
        """
        others = [other for other in self._peers if other is not peer and other.side is identity.side]
        for other in others:
            if why := why_kept(other, proof, peer.host, self._live.now):
                raise UnknownTeamError(f"it claims to be {identity.side}'s, and {why}")
        for other in others:
            self._log(f"{identity.side}'s base station {other.name} is replaced by {peer.name}")
            self._drop(other)
        protocol = identity.protocol or peer.protocol
        changed = (peer.side, peer.protocol) != (identity.side, protocol)
        peer.side, peer.protocol = identity.side, protocol
        peer.proof = max(proof, peer.proof) if not changed else proof
        if identity.address is not None:
            changed = changed or self._addresses.get(peer.side) != identity.address
            self._addresses[peer.side] = identity.address
        if changed:
            self._log(f"{peer.side}'s base station is {peer.name}")
            self._welcome(peer)

    def _welcome_unidentified(self, peer: Peer) -> None:
        if peer.side is None:
            self._welcome(peer)

    def _welcome(self, peer: Peer) -> None:
        """Send its own address, and whether the game runs: a team that connects late must know of a stop."""
        state = self._live.state
        running = START if state is not None and state.running else STOP
        if peer.protocol is BoxProtocol.CHARACTERS:
            self._send(peer, (_WELCOME.character + running.character).encode("ascii"))
            return
        address = self._targets()[peer.side] if peer.side is not None else ""
        self._send(peer, commands.write(BoxCommand(_WELCOME, address)) + commands.write(BoxCommand(running)))

    def _send(self, peer: Peer, text: bytes) -> None:
        transport = peer.writer.transport
        if not text or transport.is_closing():
            return
        peer.writer.write(text)
        if transport.get_write_buffer_size() > UNREAD:
            self._refuse(peer, "base station that does not read")

    def _drop(self, peer: Peer) -> None:
        if peer in self._peers:
            self._peers.remove(peer)
        peer.writer.transport.abort()

    def _forget(self, peer: Peer) -> None:
        self._drop(peer)
        odd = f"; {peer.framer.garbage} pieces that were not a message" if peer.framer.garbage else ""
        if peer.side is not None:
            summary = self.team_states[peer.side].summary()
            self._log(f"{peer.side}'s base station {peer.name} is gone; {summary}{odd}")
        elif peer.framer.garbage:
            self.refusals.note("connection without an identity", peer.host, odd[2:])
