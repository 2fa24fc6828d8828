"""Stands between a brain and hardware: states, arming, limits, deadlines, the fallback, and figures of all of it."""

import math
import re
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from robot_agent.hardware.contract import Hardware, SensorReadings
from robot_agent.hardware.limits import kick_within_limits, toward, within_limits
from robot_agent.hardware.reading_checks import MOTION, ReadingChecks
from robot_agent.hardware.settings import HardwareSettings
from runtime.process.clock import Clock
from runtime.process.process_log import Level, log_line
from schemas.config.robot_model import RobotModel
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.messages.hardware import CallHealth, Fallback, HardwareHealth, HardwareState
from schemas.messages.health import MAX_FAULT

_AT_REST = Drive()
_LONGEST_STEP = 0.05
"""s for which a demand may gain or lose speed at once; after a pause it does so in steps, as without one."""
_METHODS = ("configure", "activate", "sense", "actuate", "deactivate", "close")
_TIMED = ("sense", "actuate")
"""The calls that have a deadline: devices may take a while to open and to close."""
_PATIENCE = 10
"""Watchdogs for which any other call may take before a line says what the process waits for."""
_NUMBER = re.compile(r"-?[\d.]+|nan|inf")
_LOOKS = 5
"""Looks at a call that takes too long until it counts as one that does not return: the whole process may have slept."""
T = TypeVar("T")


class HardwareError(Exception):
    """Hardware has failed; the text names the call and the fault."""


class HardwareGuard:
    """One robot's hardware. `watch` may be called by another thread, all else by one."""

    def __init__(
        self,
        hardware: Hardware,
        settings: HardwareSettings,
        model: RobotModel,
        robot: str,
        clock: Clock,
        *,
        armed: bool,
    ) -> None:
        """Guard hardware that is not configured yet.

        Raises:
            TouchlineError: a method of the contract is missing.
        """
        missing = [name for name in _METHODS if not callable(getattr(hardware, name, None))]
        if missing:
            raise TouchlineError(
                f"the hardware {type(hardware).__name__} has no {', '.join(missing)}; write each method"
            )
        self.state = HardwareState.UNCONFIGURED
        self.refused: list[str] = []
        """Why parts of the newest demand were not carried out."""
        self._hardware, self.settings, self._model = hardware, settings, model
        self._robot, self._clock, self._armed = robot, clock, armed
        self._began = clock.now()
        self._checks = ReadingChecks(model.drive, settings.jump, settings.relocation)
        self._lock = threading.RLock()
        self._calls: dict[str, _Call] = {}
        self._overdue_looks = 0
        """Looks of the other thread, one after the other, at a call that takes too long."""
        self._in_call: tuple[str, float] | None = None
        """The call that has not returned, and when it began."""
        self._sent, self._sent_at = _AT_REST, self.time
        self._demanded_at: float | None = None
        """When a brain last demanded something; None before that, and while the robot has fallen back."""
        self._fell_back = self._clamped = self._filtered = 0
        self._reason = ""
        self._reported: set[str] = set()

    @property
    def time(self) -> float:
        """s since the robot's process began."""
        return self._clock.now() - self._began

    def start(self) -> None:
        """Configure the hardware, and activate it if the robot is armed.

        Raises:
            HardwareError: it fails.
        """
        self._call("configure", self._hardware.configure)
        self.state = HardwareState.INACTIVE
        if self._armed:
            self._call("activate", self._hardware.activate)
            self.state = HardwareState.ACTIVE
        else:
            log_line(f"{self._robot}: not armed: sensors are read, motors get nothing; --arm lets it move")

    def sense(self) -> SensorReadings:
        """What was measured since the last call, without readings that cannot be true.

        Raises:
            HardwareError: the hardware fails.
        """
        readings, faults = self._call("sense", self._sense)
        for fault in faults:
            self._report(fault)
            if fault.startswith(MOTION) and not self._reason:
                self._reason = fault  # without poses there are no demands
        return readings

    def actuate(self, command: Command, wanted: Drive | None = None) -> None:
        """Carry out a command within the limits of the model; without effect while inactive.

        `wanted` is the demand before the filter for clearance, where there is one.

        Raises:
            HardwareError: the hardware fails.
        """
        if self.state is not HardwareState.ACTIVE:
            self.refused = [f"kick: the hardware is {self.state.value}"] if command.kick is not None else []
            return
        with self._held("actuate"):
            self.refused = []
            if wanted is not None and wanted is not command.drive:
                self._filtered += 1
                self.refused = ["drive: changed to keep the clearance"]
            self._demanded_at, self._reason = self.time, ""
            drive = within_limits(command.drive, self._model)
            kick = kick_within_limits(command.kick, self._model) if command.kick is not None else None
            self._clamped += drive is not command.drive or kick is not command.kick
            drive = self._ramped(drive)
            self._call("actuate", lambda: self._hardware.actuate(drive, kick, command.dribble))

    def watch(self) -> bool:
        """Fall back where no demand has come for too long; to be called at the control rate.

        Returns False if a call has not returned for so long: then only the end of the process stops the robot.
        """
        called = self._in_call
        is_overdue = called is not None and self._clock.now() - called[1] > self.settings.watchdog
        self._overdue_looks = self._overdue_looks + 1 if is_overdue else 0
        if called is not None and self._overdue_looks >= _LOOKS:
            self._fail(f"{called[0]} has not returned for {self.settings.watchdog:g} s")
            return False
        if self.state is not HardwareState.ACTIVE or not self._lock.acquire(blocking=False):
            return True
        try:
            silent = self._demanded_at is None or self.time - self._demanded_at > self.settings.watchdog
            if silent:
                self._fall_back()
        except HardwareError:
            return True  # the thread that senses gets the same one
        finally:
            self._lock.release()
        return True

    def stop(self) -> None:
        """Bring the robot to rest, and close the hardware, whatever its state."""
        for name, call in (("deactivate", self._hardware.deactivate), ("close", self._hardware.close)):
            if name == "close" or self.state in (HardwareState.ACTIVE, HardwareState.ERROR):
                try:
                    self._call(name, call)
                except HardwareError as error:
                    log_line(f"{self._robot}: {error}", Level.ERROR)
        if self.state is not HardwareState.ERROR:
            self.state = HardwareState.UNCONFIGURED

    def health(self) -> HardwareHealth:
        """The figures so far."""
        return HardwareHealth(
            time=round(self.time, 3),
            robot=self._robot,
            state=self.state,
            armed=self._armed,
            fallback=self.settings.fallback,
            fell_back=self._fell_back,
            clamped=self._clamped,
            filtered=self._filtered,
            reason=self._reason[:MAX_FAULT],
            devices=self._checks.health(self.time),
            calls={name: call.health() for name, call in self._calls.copy().items()},  # the other thread may add one
        )

    def _fall_back(self) -> None:
        if self._demanded_at is not None:
            self._demanded_at = None
            self._fell_back += 1
            self._reason = self._reason or f"no demand for {self.settings.watchdog:g} s"
            self._report(f"{self._reason}: {self.settings.fallback.value}")
        drive = self._ramped(_AT_REST) if self.settings.fallback is Fallback.BRAKE else None
        if drive is None:
            self._sent = _AT_REST  # the next demand begins there
        self._call("actuate", lambda: self._hardware.actuate(drive, None, False))

    def _sense(self) -> tuple[SensorReadings, list[str]]:
        read = self._hardware.sense(self.time)
        if not isinstance(read, SensorReadings):
            raise TypeError(f"it returned {read!r:.80}; return SensorReadings")
        try:
            return self._checks.accept(read, self.time)
        except (TypeError, AttributeError) as error:
            raise TypeError(f"it returned {read!r:.200}; a part has another type than the contract: {error}") from error

    @contextmanager
    def _held(self, name: str) -> Iterator[None]:
        """Exclude the other thread, unless a call of that one does not return.

        Raises:
            HardwareError: it does not.
        """
        if not self._lock.acquire(timeout=self.settings.watchdog):
            called = self._in_call
            self._fail(f"{called[0] if called else name} has not returned for {self.settings.watchdog:g} s")
            raise HardwareError(self._reason)
        try:
            yield
        finally:
            self._lock.release()

    def _ramped(self, demand: Drive) -> Drive:
        """The demand within the accelerations of the model since the last one."""
        now = self.time
        self._sent = toward(self._sent, demand, self._model, min(_LONGEST_STEP, now - self._sent_at))
        self._sent_at = now
        return self._sent

    def _call(self, name: str, method: Callable[[], T]) -> T:
        """Call a method of the hardware, and keep what it took.

        Raises:
            HardwareError: it raised, or the hardware has failed before.
        """
        with self._held(name):
            if self.state is HardwareState.ERROR and name not in ("deactivate", "close"):
                raise HardwareError(self._reason)
            began = self._clock.now()
            self._in_call = name, began
            waits = None if name in _TIMED else self._said_after(name, _PATIENCE * self.settings.watchdog)
            try:
                return method()
            except (Exception, SystemExit) as error:
                text = f"{name} raised {type(error).__name__}: {' '.join(str(error).split())}"
                if name not in ("deactivate", "close"):
                    self._fail(text)
                raise HardwareError(text) from error
            finally:
                self._in_call = None
                if waits is not None:
                    waits.cancel()
                took = self._clock.now() - began
                call = self._calls.get(name, _Call())
                call.add(took, self.settings.deadline if name in _TIMED else math.inf)
                self._calls[name] = call
                if took > self.settings.deadline and name in _TIMED:
                    self._report(f"{name} takes longer than its deadline of {1e3 * self.settings.deadline:g} ms")

    def _said_after(self, name: str, seconds: float) -> threading.Timer:
        """A thread that says after this wall time that a call has not returned."""
        text = f"{name} has not returned for {seconds:g} s; the process waits for it"
        waits = threading.Timer(seconds, self._report, (text,))
        waits.daemon = True
        waits.start()
        return waits

    def _fail(self, reason: str) -> None:
        if self.state is not HardwareState.ERROR:
            self.state, self._reason = HardwareState.ERROR, reason
            self._report(f"the hardware has failed: {reason}", Level.ERROR)

    def _report(self, text: str, level: Level = Level.WARNING) -> None:
        """Log a fault once; all of them are counted. Faults of one kind differ in their numbers."""
        kind = _NUMBER.sub("", text)
        if kind not in self._reported:
            self._reported.add(kind)
            log_line(f"{self._robot}: {text}", level)


class _Call:
    """What the calls of one method took."""

    def __init__(self) -> None:
        self._calls = self._late = 0
        self._sum = self._worst = 0.0

    def add(self, took: float, deadline: float) -> None:
        """Add a call, both in s."""
        self._calls += 1
        self._late += took > deadline
        self._sum += took
        self._worst = max(self._worst, took)

    def health(self) -> CallHealth:
        """The figures in ms."""
        mean = round(1e3 * self._sum / self._calls, 3)
        return CallHealth(calls=self._calls, late=self._late, mean_ms=mean, worst_ms=round(1e3 * self._worst, 3))
