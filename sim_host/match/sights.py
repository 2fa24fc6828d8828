"""Sights: what each robot perceives and receives in one tick.

Ten sights a tick are most of what a host publishes.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from msgspec import Raw

from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.percept import Percept
from schemas.messages.sight import Outcome, Sight
from schemas.messages.soccer.game import GameView
from schemas.side import Side
from schemas.wire.part import encode
from sim_host.match.radio import RadioAir, as_it_is
from sim_host.match.world_fields import Fields
from sim_host.sensing.perception import Perception
from sim_host.sensing.sensors.suite import Readings, SensorSuite
from sim_host.snapshot import Roster, Snapshot

Send = Callable[[str, bytes], None]
"""Sends a robot, by its name, its encoded sight."""


class TickSights(Mapping[str, bytes]):
    """Robot → its encoded sight of one tick. A sight that was not sent is made and encoded when it is first read."""

    def __init__(self, robots: Sequence[str], made: Iterator[Sight]) -> None:
        self._robots, self._made = robots, made
        self.encoded: dict[str, bytes] = {}

    @cached_property
    def perceived(self) -> dict[str, Sight]:
        """The same as messages; none where they were sent. Robots and ticks share parts of them: a reader must not
        change these."""
        return {sight.robot: sight for sight in self._made}

    def __getitem__(self, robot: str) -> bytes:
        if robot not in self.encoded:
            self.encoded[robot] = self.perceived[robot].encode()
        return self.encoded[robot]

    def __iter__(self) -> Iterator[str]:
        return iter(self._robots)

    def __len__(self) -> int:
        return len(self._robots)


def _once_encoded(part: Any) -> Any:
    """A part of many sights that are sent: it is encoded once, for all of them."""
    return Raw(encode(part))


class Sights:
    """Makes the sights of all robots of a match."""

    def __init__(self, roster: Roster, perception: Perception, radio: RadioAir, sensors: SensorSuite) -> None:
        self._roster = roster
        self._perception = perception
        self._radio = radio
        self._sensors = sensors

    @property
    def readings(self) -> Fields:
        """The field of a `schemas.messages.world.World` on what was read in the newest tick."""
        return {"sensors": self._sensors.fresh} if self._sensors.fresh else {}

    def at(
        self,
        snapshot: Snapshot,
        cyan_attacks: int,
        views: Callable[[], Mapping[Side, GameView]],
        stuck: Sequence[bool],
        orders: Mapping[Side, CoachOrder],
        commands: Mapping[str, Command],
        refusals: Mapping[str, list[str]],
        send: Send | None,
    ) -> TickSights:
        """The sights of all robots; with `send`, each is sent as soon as it is made, else made when they are read.

        `views`: side → the game from its point of view.
        """
        shared = as_it_is if send is None else _once_encoded
        made = self._made(
            snapshot,
            self._perception.at(snapshot, cyan_attacks),
            [dict(readings) for readings in self._sensors.at(snapshot)],
            self._radio.receive(snapshot.tick, shared),
            lambda: {side: shared(view) for side, view in views().items()},
            stuck,
            dict(orders),
            dict(commands),
            refusals,
        )
        sights = TickSights(self._roster.names, made)
        if send is not None:
            for sight in made:
                sights.encoded[sight.robot] = encoded = sight.encode()
                send(sight.robot, encoded)
        self._perception.develop()
        return sights

    def _made(
        self,
        snapshot: Snapshot,
        percepts: Iterator[Percept],
        readings: list[Readings],
        received: Iterator[dict[str, Any]],
        games: Callable[[], dict[Side, Any]],
        stuck: Sequence[bool],
        orders: Mapping[Side, CoachOrder],
        commands: Mapping[str, Command],
        refusals: Mapping[str, list[str]],
    ) -> Iterator[Sight]:
        """The sights of all robots, made when they are read, of what was at this tick."""
        game, robots = games(), zip(self._roster.names, self._roster.sides, percepts, received, strict=True)
        for index, (name, side, percept, heard) in enumerate(robots):
            command = commands.get(name)
            yield Sight(
                tick=snapshot.tick,
                time=snapshot.time,
                robot=name,
                side=side,
                self=percept.motion(),
                ball=percept.ball_sight(),
                holding=name == snapshot.possession,
                kicker_ready=snapshot.kickers_ready[index],
                stuck=stuck[index],
                obstacles=percept.obstacles,
                obstacles_age=percept.obstacles_age,
                radio=heard,
                game=game[side],
                order=orders.get(side),
                outcome=Outcome(
                    answers_tick=command.answers_tick if command is not None else None,
                    refused=refusals.get(name, []),
                ),
                sensors=readings[index],
            )
