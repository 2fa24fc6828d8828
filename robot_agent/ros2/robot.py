"""One robot that ROS 2 nodes drive: its endpoints in the graph, and the runner that joins them with the match."""

import threading
from collections import Counter
from collections.abc import Callable
from typing import Any

from msgspec.json import Decoder

from robot_agent.process.runner import Runner
from robot_agent.ros2.answers import Answers, Fault, SightHead
from robot_agent.ros2.clock_keeper import ClockKeeper
from robot_agent.ros2.sight_messages import SightMessages
from robot_agent.ros2.velocity import read_velocity
from runtime.bus.contract import Bus, Subscription
from runtime.process.process_log import Level, log_line
from runtime.process.timing import REPLY_S
from runtime.ros2.graph import Arrived, Graph, Request
from runtime.ros2.graph_names import Endpoint, Kind, gid_of
from runtime.ros2.message_types import hash_of, typestore
from runtime.ros2.topic_type import FLAG, KICK, TWIST, TWIST_STAMPED, TopicType
from schemas.config.match_config import LOCKSTEP
from schemas.messages.command import Command, Kick, KickMode
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.wire.faults import FaultError

_COMMANDS = {one.message: one for one in (TWIST, TWIST_STAMPED)}
"""The types of messages that drive a robot."""
_read_head = Decoder(SightHead).decode


class RosRobot:
    """The topics and the service of one robot: `cmd_vel`, `dribble` and `kick` in, what it perceives out."""

    def __init__(self, graph: Graph, name: str, keeper: ClockKeeper, every: int) -> None:
        """`every` as in `Ros2Settings`."""
        self.name = name
        self.messages = SightMessages(graph, name, keeper.transforms)
        self._keeper, self._every = keeper, every
        self._store = typestore()
        self._lock = threading.Lock()
        self.counts: Counter[str] = Counter()
        """What was wrong with commands, in this match."""
        self._answers: Answers | None = None
        self._send: Callable[[Command], None] | None = None
        self._drivers: dict[bytes, str] = {}
        """Identity → node, of the publishers of commands."""
        for topic_type in _COMMANDS.values():
            graph.subscribe(f"/{name}/cmd_vel", topic_type, self._receiver(topic_type))
        graph.subscribe(f"/{name}/dribble", FLAG, self._receive_dribble)
        graph.serve(f"/{name}/kick", KICK, self._serve_kick)
        graph.watch(f"/{name}/cmd_vel", Kind.PUBLISHER, self._follow)

    def begin(self, setup: Setup) -> "RosRobot":
        """Take part in a match, or in another one."""
        with self._lock:
            is_lockstep = setup.pace == LOCKSTEP
            self.counts.clear()
            self._answers = Answers(
                setup.time.tick, self._report, self.counts, is_lockstep=is_lockstep, every=self._every
            )
            self._answers.is_driven = bool(self._drivers)
        self.messages.use_sensors(setup.sensors_of(self.name))
        self._keeper.begin(setup.sides)
        return self

    @property
    def is_driven(self) -> bool:
        """Whether a node publishes commands."""
        return bool(self._drivers)

    def answer_by(self, send: Callable[[Command], None]) -> None:
        """What sends the robot's commands."""
        self._send = send

    def see(self, sight: Sight | SightHead, *, is_new: bool) -> None:
        """Publish a sight, unless it is a head; it is answered now or later, unless it is a repetition."""
        answers = self._answers
        assert answers is not None
        if is_new:
            with self._lock:
                self._answer(answers.see(sight))
        if isinstance(sight, Sight):
            self.messages.publish(sight, self.counts)
        self._keeper.seen(self.name, sight.tick, round(sight.time * 1e9))

    def _receiver(self, topic_type: TopicType) -> Callable[[Arrived], None]:
        is_stamped = topic_type is TWIST_STAMPED

        def receive(arrived: Arrived) -> None:
            answers = self._answers
            if answers is None:
                return
            with self._lock:
                if arrived.attachment is None:
                    self._answer(answers.refuse("a command has no attachment of rmw_zenoh"))
                    return
                gid = arrived.attachment.gid
                who = self._name_of(gid)
                try:
                    velocity = read_velocity(arrived.payload, is_stamped=is_stamped)
                except ValueError as error:
                    self._answer(answers.refuse(f"{who}: no {topic_type.message}: {error}"))
                    return
                self._answer(answers.command(velocity, gid, who))

        return receive

    def _receive_dribble(self, arrived: Arrived) -> None:
        with self._lock:
            if self._answers is not None:
                self._answers.dribble = arrived.payload[4:5] == b"\x01"

    def _serve_kick(self, request: Request) -> None:
        reason = self._kick(request.payload)
        reply = self._store.types[f"{KICK.message}_Response"](not reason, reason)
        request.reply(self._store.serialize_cdr(reply, f"{KICK.message}_Response"))

    def _kick(self, payload: bytes) -> str:
        """Kick as requested; why that is impossible, or empty."""
        try:
            asked: Any = self._store.deserialize_cdr(payload, f"{KICK.message}_Request")
            kick = Kick(mode=asked.mode or KickMode.GROUND, speed=asked.speed)
        except FaultError as error:
            return str(error)
        except Exception as error:  # whatever rosbags raises at bytes of another form
            return f"no {KICK.message}: {error}"
        with self._lock:
            return self._answers.kick(kick) if self._answers is not None else "the match has not begun"

    def _follow(self, endpoint: Endpoint, is_there: bool) -> None:
        """A publisher of the topic of commands has come or gone."""
        known = _COMMANDS.get(endpoint.message)
        if known is None or endpoint.type_hash != hash_of(known):
            if is_there:
                self.counts[Fault.OTHER_TYPE] += 1
                wanted = " or ".join(_COMMANDS)
                self._report(
                    Fault.OTHER_TYPE,
                    f"{endpoint.node} publishes {endpoint.topic} as {endpoint.message}, {endpoint.type_hash}, which is "
                    f"not received; it is {wanted} of ROS 2 Jazzy or later",
                )
            return
        with self._lock:
            gid = gid_of(endpoint.token)
            if is_there:
                self._drivers[gid] = endpoint.node
            else:
                self._drivers.pop(gid, None)
            if self._answers is not None:
                self._answer(self._answers.driven(bool(self._drivers)))

    def _name_of(self, gid: bytes) -> str:
        """The node that publishes commands with this identity; some libraries announce another one in their token."""
        known = self._drivers
        return known.get(gid) or (next(iter(known.values())) if len(known) == 1 else "a node without a name")

    def _answer(self, command: Command | None) -> None:
        if command is not None and self._send is not None:
            self._send(command)

    def _report(self, fault: Fault, sentence: str) -> None:
        where = f"/{self.name}/diagnostics"
        log_line(f"{self.name}: {sentence} ({fault.value}; further ones are counted in {where})", Level.WARNING)


class RosRunner(Runner):
    """Gives the sights of a robot to its nodes, and sends their commands, which come on the thread of the graph."""

    def __init__(self, bus: Bus, robot: RosRobot, name: str, sights: Subscription | None = None) -> None:
        super().__init__(bus, robot, name, sights)  # type: ignore[arg-type]
        self._robot = robot
        self._sending = threading.Lock()
        self._published_at = 0.0
        robot.answer_by(self._answer_with)

    def read(self, payload: bytes) -> Any:
        """The sight in a payload, or its head while no node reads it; None if it is none, which is counted."""
        if not self._robot.messages.is_read:
            try:
                return _read_head(payload)
            except (ValueError, RecursionError):
                pass  # what reads all of it says why
        return super().read(payload)

    def answer(self, sight: Sight | SightHead) -> None:
        """Publish the sight. It is answered once a node has sent its command; one that is sent again, again."""
        self._clock.sim_ns = round(sight.time * 1e9)
        is_new = sight.tick != self._last_tick
        with self._sending:
            if not is_new and self._last_answer:
                self._repeat()
                return
            if is_new:
                self._last_tick, self._last_answer = sight.tick, b""
        now = self._clock.now()
        if not is_new and now - self._published_at < REPLY_S:
            return  # the nodes are busy: what came again would be answered twice
        self._published_at = now
        self._robot.see(sight, is_new=is_new)

    def _answer_with(self, command: Command) -> None:
        with self._sending:
            self._last_answer = command.encode()
            self._send()
