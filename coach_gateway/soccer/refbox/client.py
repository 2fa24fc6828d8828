"""A team's base station at a league's referee box: forwards the box's commands, and uploads world states to it.

A broken link is reconnected after a pause that grows. While it is up, the referee's actions are locked for everyone
else: the host sees a liveliness token of this process, so nothing has to be unlocked when the process dies.
"""

import asyncio
import json
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from coach_gateway.access.referee_name import box_name
from coach_gateway.match.live import LiveMatch
from coach_gateway.service import pause, until_first
from coach_gateway.soccer.refbox import DEFAULT_PORT, commands
from coach_gateway.soccer.refbox.forwarding import WAITS_FOR_START, SignalResponse, is_ours, response_to, speaks_for
from coach_gateway.soccer.refbox.framing import Framer
from coach_gateway.soccer.refbox.own_world_state import own_world_state
from coach_gateway.soccer.refbox.signal_queue import BoxSignal, SignalQueue
from coach_gateway.timing import BOX_FIRST_PAUSE_S, BOX_PERIOD_S, SILENCE_S, START_AGAIN_S, UNREAD_S
from runtime.process.process_log import NOTE
from runtime.process.timing import GIVE_UP_S
from schemas.errors import TouchlineError
from schemas.messages.coach import CoachMode
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.messages.soccer.league.signals import BY_CHARACTER, Signal
from schemas.side import Side
from schemas.soccer.game import OfficiatingMode

UNREAD_BYTES = 262_144
"""Bytes of world states that wait for a box that does not read; beyond them, newer ones are left out."""
_START_S = 10.0
"""s of simulated time during which START is repeated: the rules' pauses are in simulated time, too."""


@dataclass(frozen=True, slots=True)
class BoxAddress:
    """The box's address and protocol, and the team whose base station this is."""

    team: Side
    host: str
    port: int = DEFAULT_PORT
    protocol: BoxProtocol = BoxProtocol.AUTO


class RefBoxClient:
    """One base station."""

    def __init__(self, live: LiveMatch, box: BoxAddress, log: Callable[[str], None]) -> None:
        """`log` is called with lines for people."""
        self._live = live
        self._box = box
        self._log = log
        self._target: str | None = None
        """The address that the box uses for this team, from its WELCOME."""
        self._parked = False
        self._noted = ""
        """The newest reason in the log."""
        self._signals = SignalQueue()
        self.connected = False
        self.counts: Counter[str] = Counter()
        """Among others `received`, `forwarded`, `refused`, `not forwarded`, `unreadable`, `dropped`, `left out`."""

    async def serve(self, stop: asyncio.Event) -> None:
        """Stay connected whenever the box is there, until `stop` is set."""
        wait = BOX_FIRST_PAUSE_S
        reported = False
        while not stop.is_set():
            try:
                reader, writer = await self._connect(stop)
            except OSError as error:
                if not (reported or stop.is_set()):
                    reported = True
                    self._log(f"referee box {self._box.host}:{self._box.port} is not there ({error}); trying again")
                await pause(stop, wait)
                wait = min(2 * wait, SILENCE_S)
                continue
            reported, received = False, self.counts["received"]
            await self._run_connection(reader, writer, stop)
            if self.counts["received"] > received:
                wait = BOX_FIRST_PAUSE_S
            await pause(stop, wait)
            wait = min(2 * wait, SILENCE_S)

    async def _connect(self, stop: asyncio.Event) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
        """Connect to the box, unless `stop` is set first.

        Raises:
            OSError: the box is not there.
        """
        reached = asyncio.create_task(asyncio.open_connection(self._box.host, self._box.port))
        stopped = asyncio.create_task(stop.wait())
        await asyncio.wait((reached, stopped), timeout=SILENCE_S, return_when=asyncio.FIRST_COMPLETED)
        stopped.cancel()
        if not reached.done():
            reached.cancel()
            await asyncio.wait((reached,))
            raise TimeoutError(f"no answer within {SILENCE_S:g} s")
        return reached.result()

    async def _run_connection(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, stop: asyncio.Event
    ) -> None:
        """Serve one connection from its beginning to its end."""
        self.counts["connections"] += 1
        self._target = None
        self._signals = SignalQueue()
        self._set_connected(True)
        self._log(f"{self._box.team} is connected to the referee box {self._box.host}:{self._box.port}")
        works = (self._read(reader), self._forward(), self._upload_states(writer))
        try:
            await until_first(stop.wait(), *works, ignored=OSError)
        finally:
            writer.transport.abort()
            self._set_connected(False)
        if not stop.is_set():
            self._log(f"the referee box is gone; {self.summary()}")

    def summary(self) -> str:
        """All counts."""
        return ", ".join(f"{count} {what}" for what, count in sorted(self.counts.items()))

    def _note_refusal(self, why: str) -> None:
        """Log why a command is unreadable or not forwarded; once, if one after the other is for the same reason."""
        if not self._has_noted(why):
            self._log(f"referee box: {why}")

    def _has_noted(self, what: str) -> bool:
        """Whether this was the last thing to be noted; now it is."""
        before, self._noted = self._noted, what
        return before == what

    def _set_connected(self, connected: bool) -> None:
        self.connected = connected
        self._live.connect_refbox(self._box.team, connected=connected)

    async def _read(self, reader: asyncio.StreamReader) -> None:
        framer = Framer(self._box.protocol)
        while data := await reader.read(4096):
            for message in framer.feed(data):
                self._read_message(message)
            self.counts["unreadable"] += framer.garbage
            framer.garbage = 0
            await asyncio.sleep(0)  # a box that floods takes turns with everything else

    def _read_message(self, message: dict[str, Any] | str) -> None:
        """Queue the signal of a message. Its team is resolved here, in the order the box sent the messages."""
        if isinstance(message, str):
            signal, side = BY_CHARACTER[message]
            self._note(signal, side, None)
            return
        try:
            command = commands.read(message)
        except commands.NoCommandError as error:
            self.counts["unreadable"] += 1
            self._note_refusal(str(error))
            return
        if command.signal.name == "WELCOME" and command.target:
            self._target = command.target
        self._note(command.signal, self._side_of(command.target), command.robot)

    def _note(self, signal: Signal, side: Side | None, robot: int | None) -> None:
        self.counts["received"] += 1
        if self._signals.put(BoxSignal(signal, side, robot)):
            self.counts["dropped"] += 1

    def _side_of(self, target: str) -> Side | None:
        """The side of a target: by the address of the welcome, or else by colour or name."""
        if not target:
            return None
        own = self._box.team
        if self._target is not None:
            return own if target == self._target else own.opponent
        names = {side.value: side for side in Side}
        if self._live.setup is not None:
            names = {team.name.lower(): side for side, team in self._live.setup.teams.items()} | names
        return names.get(target.lower())

    async def _forward(self) -> None:
        """Forward the signals one after the other, once there is a match that can be officiated."""
        while self._live.state is None or self._live.setup is None:
            await asyncio.sleep(BOX_PERIOD_S)
        if self._live.setup.officiating is not OfficiatingMode.MANUAL:
            self._log("our own referee still decides beside the box; start the match with --referee manual")
        while True:
            signal, side, number = await self._signals.next()
            if not is_ours(signal, side, self._box.team, self._live.refboxes):
                continue
            robot = self._robot(side, number)
            if number is not None and robot is None and side is not None:
                self._note_refusal(f"{signal.name} names robot {number}, and no robot of {side} has that number")
            wanted = response_to(signal, side, robot, self._live.state)
            if wanted.reason:
                self.counts["not forwarded"] += 1
                self._note_refusal(wanted.reason)
            await self._order(wanted.order, signal)
            await self._act(wanted)

    def _robot(self, side: Side | None, number: int | None) -> str | None:
        sides = self._live.sides
        numbers = numbers_of(sides)
        return next((name for name, its in numbers.items() if its == number and sides[name] is side), None)

    async def _act(self, wanted: SignalResponse) -> None:
        """Ask for the actions; a refused action does not stop those after it, since the box has decided all of them."""
        for action in wanted.actions:
            if wanted.until_running and action is wanted.actions[-1]:
                await self._start(action)
            else:
                await self._ask(action)

    async def _ask(self, action: RefereeAction) -> None:
        """Ask for an action until the host has replied: the box does not repeat it, and START must not overtake it."""
        about = " ".join(filter(None, (action.action, action.side, action.robot)))
        while (reply := await self._reply_to(action)) is None:
            if not self._has_noted(about):
                self._log(f"{NOTE}{about} of the referee box: no reply of the host; it is repeated, later signals wait")
            self.counts["repeated"] += 1
            await asyncio.sleep(START_AGAIN_S)
        self.counts["forwarded" if reply.accepted else "refused"] += 1
        if not reply.accepted:
            self._note_refusal(reply.reason)

    async def _reply_to(self, action: RefereeAction) -> ActionReply | None:
        """The reply; None without one. A host that is only slow replies within the patience, and acts once."""
        try:
            return await self._live.act_in_time(self._named(action), GIVE_UP_S)
        except TouchlineError:
            return None

    def _named(self, action: RefereeAction) -> RefereeAction:
        """The action with the name of the box, which is one referee for all base stations that are connected to it."""
        return action.replace(referee=box_name(self._box.host, self._box.port))

    async def _start(self, action: RefereeAction) -> None:
        """Repeat START until the game runs, unless the box changes the game otherwise meanwhile.

        Cards and repairs do not: the league's box sends them right behind START.
        """
        until = self._live.time + _START_S
        reason = "" if self._live.follower.host_present else "START is not forwarded: no host plays"
        while (
            not self._signals.changes_game
            and self._live.follower.host_present
            and self._live.time < until
            and self._waits_for_start()
        ):
            reply = await self._live.act(self._named(action))
            reason = reply.reason
            await asyncio.sleep(START_AGAIN_S)
        lost = bool(reason) and self._waits_for_start()
        self.counts["refused" if lost else "forwarded"] += 1
        if lost:
            self._note_refusal(reason)

    def _waits_for_start(self) -> bool:
        state = self._live.state
        return state is not None and state.phase in WAITS_FOR_START and not state.running

    async def _order(self, mode: CoachMode | None, signal: Signal) -> None:
        """Send the order of a signal; robots that were parked play again when the game goes on."""
        if mode is None and self._parked and signal.phase is not None:
            mode = CoachMode.PLAY
        if mode is None:
            return
        self._parked = mode is CoachMode.PARK
        for side in speaks_for(self._box.team, self._live.refboxes):
            try:
                await self._live.order(side, mode=mode)
                self.counts["forwarded"] += 1
            except TouchlineError as error:
                self.counts["refused"] += 1
                self._note_refusal(str(error))

    async def _upload_states(self, writer: asyncio.StreamWriter) -> None:
        """Send the newest world state at a steady rate; returns when the box has not read for too long."""
        due = read_at = self._live.now
        while True:
            waiting = writer.transport.get_write_buffer_size()
            if waiting < UNREAD_BYTES:
                read_at = self._live.now
                self._upload(writer)
            elif self._live.now - read_at > UNREAD_S:
                return
            else:
                self.counts["left out"] += 1
            due = max(due + BOX_PERIOD_S, self._live.now)
            await asyncio.sleep(due - self._live.now)

    def _upload(self, writer: asyncio.StreamWriter) -> None:
        live, team = self._live, self._box.team
        world, setup = live.world, live.setup
        if world is None or setup is None:
            return
        view = own_world_state(team, setup, live.sides, live.state, world, live.beliefs([team]))
        writer.write(json.dumps(view, separators=(",", ":")).encode() + b"\x00")
        self.counts["uploaded"] += 1
