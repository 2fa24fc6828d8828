"""The match that nodes control: its newest world, and the requests of an operator to its host."""

from collections.abc import Mapping
from typing import Any

from robot_agent.ros2.simulation.codes import Code, RefusedError
from robot_agent.ros2.simulation.entities import Entity, entities_of
from runtime.bus.contract import Bus, BusError, NoReplyError
from runtime.process.timing import POLL_S, REQUEST_S
from schemas.messages.pace import PaceOperation, PaceReply, PaceRequest
from schemas.messages.scene import SceneRequest
from schemas.messages.setup import Setup
from schemas.messages.world import World
from schemas.topic import Topic
from schemas.topics import PACE, SCENE, WORLD
from schemas.wire.faults import FaultError
from schemas.wire.message import BadMessageError, Message
from schemas.wire.part_faults import validated

SOURCE = "ros2"
"""Name of the sender of requests."""


class MatchClient:
    """Reads the truth of a match, and changes it with the rights of its operator."""

    def __init__(self, bus: Bus, setup: Setup) -> None:
        self._bus = bus
        self._worlds = bus.subscribe(WORLD, newest=True)
        self._sizes = setup.robot.reach, setup.ball.radius
        self._world: World | None = None
        self._changed: dict[str, Entity | None] = {}
        """Bodies that were changed since the newest world; None for one that was removed."""

    def world(self, timeout: float = 0.0) -> World | None:
        """The newest world, waiting up to `timeout` s for a newer one; None before the first."""
        received = self._worlds.receive(timeout)
        if received is not None:
            self._world = received.message()
            self._changed.clear()
        return self._world

    def entities(self) -> dict[str, Entity]:
        """All bodies by name.

        Raises:
            RefusedError: no tick of the match has been received yet.
        """
        world = self.world()
        if world is None:
            raise RefusedError(Code.INCORRECT_STATE, "no tick of the match has come yet; let it run, or step it")
        return entities_of(world, *self._sizes)

    def coming(self) -> dict[str, Entity]:
        """All bodies by name, with what was changed since the newest world.

        Raises:
            RefusedError: no tick of the match has been received yet.
        """
        return {name: one for name, one in (self.entities() | self._changed).items() if one is not None}

    def pace(self, operation: PaceOperation, ticks: int = 1) -> PaceReply:
        """The state of the match after an operation on its pace, which the host may have refused.

        Raises:
            RefusedError: the host does not reply, or such a number of ticks is none.
        """
        reply: PaceReply = self._ask(PACE, PaceRequest, operation=operation, ticks=ticks)
        return reply

    def change(self, changed: Mapping[str, Entity | None], **content: Any) -> None:
        """Change the scene, from the next tick on; `changed` are the bodies after it, None for one that is removed.

        Raises:
            RefusedError: it is impossible, the host refuses it, or it does not reply.
        """
        reply = self._ask(SCENE, SceneRequest, **content)
        if not reply.accepted:
            raise RefusedError(Code.FAILED, reply.reason)
        self.world()  # one from before the reply does not show the change
        self._changed |= changed

    def _ask(self, topic: Topic, kind: type[Message], **content: Any) -> Any:
        try:
            request, clock = validated(kind, {**content, "source": SOURCE}), self._bus.clock
        except FaultError as error:
            raise RefusedError(Code.FAILED, str(error)) from None
        deadline = clock.now() + REQUEST_S
        while True:
            try:
                return self._bus.query(topic, request, REQUEST_S).result(REQUEST_S)
            except (NoReplyError, BadMessageError, BusError) as error:
                if type(error) is not NoReplyError or clock.now() >= deadline:
                    raise RefusedError(Code.FAILED, f"the match's host does not reply: {error}") from None
            clock.sleep_until(clock.now() + POLL_S)  # its router drops a query that follows another one at once
