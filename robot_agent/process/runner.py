"""Runs one brain on the bus: a sight in, a command out, until the host leaves or the process is ended."""

import gc
from collections.abc import Callable

from robot_agent.loading.brain_error import BrainError, RobotError
from robot_agent.loading.brain_reload import BrainReload
from robot_agent.process.claim import Membership
from robot_agent.process.settings import FIRST_SIGHT_FAILED
from robot_agent.process.timing import IDLE_S
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Bus, NoReplyError, RefusedQueryError, Stamp
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

    def __init__(self, bus: Bus, brain: Brain, robot: str) -> None:
        self.brain = brain
        self.answered = 0
        self.repeated = 0
        """Sights that came again, and got the same command again."""
        self.invalid = 0
        """Payloads on the sight's key that were not a sight."""
        self._clock = bus.clock
        self._sights = bus.subscribe(SIGHT, robot=robot)
        self._commands = bus.publisher(COMMAND, robot=robot)
        self._last_tick: int | None = None
        self._last_answer = b""
        self._stamp = Stamp(0, 0, 0)
        """Of the last answer."""

    def next_sight(self, timeout: float | None) -> Sight | None:
        """The newest sight, waiting up to `timeout` s for one (None: for ever)."""
        payload = self._sights.receive_payload(timeout)
        if payload is None:
            return None
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


def serve(
    bus: Bus,
    build: Callable[[Setup], Brain],
    robot: str,
    patience: float,
    membership: Membership | None = None,
    runner_class: Callable[[Bus, Brain, str], Runner] = Runner,
    reload: BrainReload | None = None,
) -> int:
    """Run a robot until its host has been gone for `patience` s; the exit status of the process.

    `membership` is the agent's, by default that of one without a launch; `runner_class` runs what `build` returns.
    `reload` builds the brain in place of `build`, and again when its code has changed between two episodes; None keeps
    the brain.

    The status is 0 if the host has gone or the bus is closed, 1 if the brain failed, and `FIRST_SIGHT_FAILED` if it did
    so at once.

    A host that has left and is back plays another match: the brain is built again before its first sight of it.

    Raises:
        TouchlineError: `build` cannot make the brain, there is no host, or it refuses the agent.
    """
    membership = membership or Membership(bus, robot, None)
    build = reload.build if reload is not None else build
    setup = ask_setup(bus, patience)
    if not membership.fits(setup):
        membership.join(setup, patience)  # the host refuses it, and reports that on its side, too
    runner = runner_class(bus, build(setup), robot)
    host = HostWatch(bus)
    membership.join(setup, patience)
    gc.collect()
    gc.freeze()
    is_new_match = False
    while not bus.closed:
        sight = runner.next_sight(IDLE_S)
        is_new_match = host.update() or is_new_match
        if sight is not None and not is_new_match:
            changed = reload.before(sight, setup) if reload is not None else None
            if changed is not None:
                runner.restart(changed)
            try:
                runner.answer(sight)
            except RobotError as error:
                log_line(error.report(), Level.ERROR, tick=sight.tick)
                return 1 if runner.answered else FIRST_SIGHT_FAILED
        elif host.is_reachable():
            if is_new_match:
                setup = ask_setup(bus, patience)
                runner.restart(build(setup))
                membership.join(setup, patience)
                is_new_match = False
        elif host.is_given_up(patience):
            log_line(f"{robot}: the host has been gone for {patience:g} s; leaving", Level.WARNING)
            return 0
        else:
            is_new_match = True
    return 0
