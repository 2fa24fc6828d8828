"""Publishes what robots' programs show their authors; the simulation never sees it."""

from collections.abc import Mapping

from runtime.bus.batch_publisher import RecordedPublishers
from runtime.bus.contract import Publisher
from schemas.messages.command import Command
from schemas.messages.debug import RobotDebug
from schemas.side import Side
from schemas.topics import DEBUG
from sim_host.game.judging import PlayState
from sim_host.snapshot import Roster


class DebugPublisher:
    """A publisher for each robot that has sent a drawing."""

    def __init__(self, batches: RecordedPublishers, tick_s: float) -> None:
        """`tick_s` is the control tick in s."""
        self._batches = batches
        self._tick_s = tick_s
        self._publishers: dict[tuple[str, Side], Publisher] = {}

    def publish(self, commands: Mapping[str, Command], roster: Roster, state: PlayState) -> None:
        """Publish the values and shapes of these commands in the field frame; `state` belongs to their sights."""
        for robot, command in commands.items():
            if command.debug is not None:
                side = roster.side_of(robot)
                debug = command.debug.in_field_frame(state.attack(side))
                tick = command.answers_tick
                frame = RobotDebug(tick=tick, time=tick * self._tick_s, robot=robot, debug=debug)
                self._publisher(robot, side).put(frame)

    def _publisher(self, robot: str, side: Side) -> Publisher:
        if (robot, side) not in self._publishers:
            self._publishers[robot, side] = self._batches.publisher(DEBUG, side=side.value, robot=robot)
        return self._publishers[robot, side]
