"""Runs one brain on the bus: a sight in, a command out, until the host leaves or the process is ended."""

import gc
from collections.abc import Callable

from robot_agent.loading.brain_error import BrainError, RobotError
from robot_agent.loading.brain_reload import BrainReload
from robot_agent.process.claim import Membership
from robot_agent.process.settings import FIRST_SIGHT_FAILED
from robot_agent.process.timing import IDLE_S
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Bus, NoReplyError, RefusedQueryError, Stamp, Subscription
from runtime.bus.host_watch import HostWatch
from runtime.process.process_log import Level, log_line
from runtime.process.timing import REPLY_S, SLICE_S
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.setup import Setup, SetupRequest
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SETUP, SIGHT
from schemas.wire.message import BadMessageError


class Runner:
    """Answers each sight of one robot once."""

    def __init__(self, bus: Bus, brain: Brain, robot: str, sights: Subscription | None = None) -> None:
        """`sights` are those of several robots, whose reader calls `read`; None for a subscription of its own."""
        self.brain = brain
        self.answered = 0
        self.repeated = 0
        """Sights that came again, and got the same command again."""
        self.invalid = 0
        """Payloads on the sight's key that were not a sight."""
        self._clock = bus.clock
        self._sights = sights or bus.subscribe(SIGHT, robot=robot)
        self._commands = bus.publisher(COMMAND, robot=robot)
        self._last_tick: int | None = None
        self._last_answer = b""
        self._stamp = Stamp(0, 0, 0)
        """Of the last answer."""

    def next_sight(self, timeout: float | None) -> Sight | None:
        """The newest sight, waiting up to `timeout` s for one (None: for ever)."""
        payload = self._sights.receive_payload(timeout)
        return self.read(payload) if payload is not None else None

    def read(self, payload: bytes) -> Sight | None:
        """The sight in a payload; None if it is none, which is counted."""
        try:
            return Sight.decode(payload)
        except BadMessageError as error:
            self._count_invalid(error)
            return None

    def answer(self, sight: Sight) -> None:
        """Send the brain's command; a repeated sight gets the same command again.

        Raises:
            BrainError: the brain raised, or returned no command.
        """
        self._clock.sim_ns = round(sight.time * 1e9)
        if sight.tick == self._last_tick:
            self._repeat()
        else:
            self._last_tick, self._last_answer = sight.tick, self._think(sight)
            self._send()

    def _send(self) -> None:
        """Send the answer to a new sight."""
        self._stamp = self._commands.put_payload(self._last_answer)
        self.answered += 1

    def _repeat(self) -> None:
        """Send the same answer again, as the same message.

        The answer may only have been late. Both may then arrive in one packet, of which the host's router may drop the
        second: that is no loss.
        """
        self._commands.put_copy(self._last_answer, self._stamp)
        self.repeated += 1

    def restart(self, brain: Brain) -> None:
        """Start over with a new brain: the next sight is of another match or episode."""
        self.brain = brain
        self._last_tick = None

    def _think(self, sight: Sight) -> bytes:
        try:
            command = self.brain.act(sight)
        except (Exception, SystemExit) as error:
            raise BrainError(sight.tick, self.brain.act) from error
        if not isinstance(command, Command):
            raise BrainError(sight.tick, self.brain.act, command)
        return command.encode()

    def _count_invalid(self, error: BadMessageError) -> None:
        self.invalid += 1
        if self.invalid == 1:
            log_line(f"a sight was skipped, and further ones will be without notice: {error}", Level.WARNING)


def ask_setup(bus: Bus, patience: float) -> Setup:
    """How the match is set up; repeats the query until the host replies.

    Raises:
        TouchlineError: no host for `patience` s of wall time, or one of another version of the protocol.
    """
    clock = bus.clock
    deadline = clock.now() + patience
    while True:
        try:
            setup: Setup = bus.query(SETUP, SetupRequest(), timeout=REPLY_S).result(REPLY_S)
        except (RefusedQueryError, BadMessageError) as error:
            raise TouchlineError(f"match {bus.match}: refused by the host: {error}") from None
        except NoReplyError as error:
            if clock.now() >= deadline:
                raise TouchlineError(
                    f"match {bus.match}: no host replied with the setup within {patience:g} s ({error}); "
                    "is --match the name of the match that the host plays?"
                ) from None
            clock.sleep_until(clock.now() + SLICE_S)
        else:
            return setup


MakeRunner = Callable[[Bus, Brain, str], Runner]


class Member:
    """A robot in its matches: a host that has left and is back plays another one, with a brain that is built anew."""

    def __init__(
        self,
        bus: Bus,
        build: Callable[[Setup], Brain],
        robot: str,
        patience: float,
        membership: Membership | None = None,
        make_runner: MakeRunner = Runner,
        reload: BrainReload | None = None,
    ) -> None:
        """Build the robot, which has not joined yet.

        `membership` is the agent's, by default that of one without a launch; `make_runner` runs what `build` returns.
        `reload` builds the brain in place of `build`, and again when its code has changed between two episodes; None
        keeps the brain.

        Raises:
            TouchlineError: `build` cannot make the brain, there is no host, or it refuses the agent.
        """
        self.robot = robot
        self.note = ""
        """Logged before the reason when the brain has failed."""
        self._bus, self._patience = bus, patience
        self._membership = membership or Membership(bus, robot, None)
        self._reload, self._build = reload, reload.build if reload is not None else build
        self._setup = ask_setup(bus, patience)
        if not self._membership.fits(self._setup):
            self.join()  # the host refuses it, and reports that on its side, too
        self.runner = make_runner(bus, self._build(self._setup), robot)
        self._host = HostWatch(bus)
        self._is_new_match = False

    def join(self) -> None:
        """Join the match.

        Raises:
            TouchlineError: the host refuses the agent.
        """
        self._membership.join(self._setup, self._patience)

    def go_on(self, sight: Sight | None) -> int | None:
        """Answer a sight, or look for the host without one; None, or at the robot's end the status of its process.

        The status is 0 if the host has been gone for `patience` s, 1 if the brain failed, and `FIRST_SIGHT_FAILED` if
        it did so at once.

        Raises:
            TouchlineError: as for the first match.
        """
        host = self._host
        self._is_new_match = host.update() or self._is_new_match
        if sight is not None and not self._is_new_match:
            return self._answer(sight)
        if host.is_reachable():
            if self._is_new_match:
                self._setup = ask_setup(self._bus, self._patience)
                self.runner.restart(self._build(self._setup))
                self.join()
                self._is_new_match = False
        elif host.is_given_up(self._patience):
            log_line(f"{self.robot}: the host has been gone for {self._patience:g} s; leaving", Level.WARNING)
            return 0
        else:
            self._is_new_match = True
        return None

    def _answer(self, sight: Sight) -> int | None:
        changed = self._reload.before(sight, self._setup) if self._reload is not None else None
        if changed is not None:
            self.runner.restart(changed)
        try:
            self.runner.answer(sight)
        except RobotError as error:
            if self.note:
                log_line(self.note, Level.ERROR)
            log_line(error.report(), Level.ERROR, tick=sight.tick)
            return 1 if self.runner.answered else FIRST_SIGHT_FAILED
        return None


def serve(bus: Bus, member: Member) -> int:
    """Run the robot of a process until it ends, or the bus is closed; the exit status, as of `Member.go_on`.

    Raises:
        TouchlineError: as `Member`.
    """
    member.join()
    gc.collect()
    gc.freeze()
    while not bus.closed:
        status = member.go_on(member.runner.next_sight(IDLE_S))
        if status is not None:
            return status
    return 0
