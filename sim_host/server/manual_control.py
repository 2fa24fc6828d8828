"""Manual control: the commands of a person replace the brain's."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from runtime.bus.contract import Bus
from schemas.messages.command import Command, Kick
from schemas.messages.manual import TIMEOUT_S, ManualDrive
from schemas.natural_order import natural_order
from schemas.topics import MANUAL
from schemas.wire.message import BadMessageError
from sim_host.server.admission.door import Admission


@dataclass(slots=True)
class _DrivenRobot:
    message: ManualDrive
    received_at: float
    """Wall time."""
    kick: Kick | None
    """Requested, and not yet part of a command."""


class ManualControl:
    """Manual control of all robots."""

    def __init__(self, bus: Bus, admission: Admission) -> None:
        self._accounts = admission.accounts
        self._subscription = bus.subscribe(MANUAL)
        self._clock = bus.clock
        self._invalid_log = admission.invalid_log
        self._driven: dict[str, _DrivenRobot] = {}
        self._reported: dict[str, bool] = {}

    def override(self, tick: int, names: tuple[str, ...], commands: Mapping[str, Command]) -> dict[str, Command]:
        """The commands that answer `tick`; of manually driven robots the person's.

        Radio messages from the brain of a driven robot are still sent.
        """
        self._receive(names)
        overridden = dict(commands)
        for name in [name for name in names if name in self._driven]:
            robot, own = self._driven[name], commands.get(name)
            overridden[name] = Command(
                answers_tick=tick,
                drive=robot.message.drive,
                dribble=robot.message.dribble,
                kick=robot.kick,
                radio=own.radio if own is not None else None,
            )
            robot.kick = None
        return overridden

    def changes(self) -> Iterator[tuple[str, bool]]:
        """Robots whose manual control has begun or ended since the last call."""
        for name in sorted({*self._driven, *self._reported}, key=natural_order):
            is_driven = name in self._driven
            if is_driven != (name in self._reported):
                yield name, is_driven
        self._reported = dict.fromkeys(self._driven, True)

    def _receive(self, names: tuple[str, ...]) -> None:
        """Process messages that have arrived, and release robots that are silent or not in the match."""
        now = self._clock.now()
        while (received := self._subscription.receive()) is not None:
            if not self._accounts.of_key(received.key).accept(len(received.payload), 1):
                continue
            name = received.chunks["robot"]
            try:
                message: ManualDrive = received.message()
                if name not in names:
                    raise BadMessageError("no robot of this match has that name")
            except BadMessageError as error:
                self._invalid_log.add(received.key, str(error), received.payload)
                continue
            if message.release:
                self._driven.pop(name, None)
                continue
            waiting = self._driven[name].kick if name in self._driven else None
            self._driven[name] = _DrivenRobot(message, now, message.kick or waiting)
        self._driven = {
            name: robot for name, robot in self._driven.items() if name in names and now - robot.received_at < TIMEOUT_S
        }
