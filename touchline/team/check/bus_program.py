"""A program that speaks the protocol itself, with a host of its own that gives it sights one by one."""

import os
import signal
import subprocess
from collections.abc import Sequence
from contextlib import suppress

from robot_agent.process.timing import PROGRAM_S
from robot_agent.sdk.contract import Briefing
from runtime.bus.contract import PresenceKind
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from runtime.process.ending import ending
from runtime.process.leash import leashed
from schemas.errors import TouchlineError
from schemas.messages.claim import AgentClaimReply
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, ROBOT_CLAIM, SETUP, SIGHT
from schemas.wire.message import BadMessageError
from touchline.timing import POLL_S, PROGRAM_ENDS_S


class BusProgram:
    """One robot's program on a bus of its own; a brain for the checks."""

    def __init__(self, command: Sequence[str], briefing: Briefing, log: list[str]) -> None:
        """Start the program, and wait until it has claimed its robot; what it does wrong is added to `log`.

        Raises:
            TouchlineError: it does not claim its robot.
        """
        self._robot, self._clock, self._log = briefing.robot, WallClock(), log
        self._setup = briefing.setup.replace(claims=True)
        endpoint = with_free_port("tcp/127.0.0.1:0")
        self._bus = open_host(self._setup.match, self._clock, endpoint)
        self._bus.declare_alive(PresenceKind.HOST, "host")
        self._setups, self._claims = self._bus.serve(SETUP), self._bus.serve(ROBOT_CLAIM)
        self._commands = self._bus.subscribe(COMMAND)
        self._sights = self._bus.publisher(SIGHT, robot=self._robot)
        environment = {
            **os.environ,
            "TOUCHLINE_CONNECT": endpoint,
            "TOUCHLINE_MATCH": self._setup.match,
            "TOUCHLINE_ROBOT": self._robot,
            "TOUCHLINE_SIDE": briefing.side.value,
        }
        self._popen = subprocess.Popen(
            [*leashed({}), *command], env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL
        )
        try:
            self._await_claim()
        except BaseException:
            self.close()
            raise

    def act(self, sight: Sight) -> Command:
        """The program's command for a sight.

        Raises:
            TouchlineError: it has ended, or does not answer.
        """
        self._bus.clock.sim_ns = round(sight.time * 1e9)
        deadline, next_send = self._clock.now() + PROGRAM_S, 0.0
        while self._clock.now() < deadline:
            if self._clock.now() >= next_send:
                self._sights.put(sight)
                next_send = self._clock.now() + POLL_S
            received = self._commands.receive(POLL_S)
            if received is not None:
                try:
                    command = Command.decode(received.payload)
                except BadMessageError as error:
                    self._log.append(f"{self._robot}: the program has sent no command: {error}")
                    return Command(answers_tick=sight.tick)
                if command.answers_tick == sight.tick:
                    return command
            self._serve()
        raise TouchlineError(
            f"{self._robot}: the program does not answer the sight of tick {sight.tick} within {PROGRAM_S:g} s"
        )

    def close(self) -> None:
        """End the program and its host."""
        for number in (signal.SIGTERM, signal.SIGKILL):
            self._popen.send_signal(number)
            with suppress(subprocess.TimeoutExpired):
                self._popen.wait(PROGRAM_ENDS_S)
                break
        self._bus.close()

    def _await_claim(self) -> None:
        deadline = self._clock.now() + PROGRAM_S
        while not self._serve():
            if self._clock.now() >= deadline:
                how = f"does not claim its robot within {PROGRAM_S:g} s; see docs/protocol.md"
                raise TouchlineError(f"{self._robot}: the program {how}")
            self._clock.sleep_until(self._clock.now() + POLL_S)

    def _serve(self) -> bool:
        """Reply to queries; returns whether the robot was claimed.

        Raises:
            TouchlineError: the program has ended.
        """
        status = self._popen.poll()
        if status is not None:
            raise TouchlineError(f"{self._robot}: the program {ending(status)}")
        while (query := self._setups.receive(0.0)) is not None:
            query.reply(self._setup)
        is_claimed = False
        while (query := self._claims.receive(0.0)) is not None:
            query.reply(AgentClaimReply(accepted=True))
            is_claimed = True
        return is_claimed
