"""Messages of a match → messages of ROS: truth, commands, beliefs, events and the state of the game.

Frames follow REP 103 and REP 105: `map` is the field frame, `<robot>/base_link` the body frame. Stamps are simulated
time, which is published on `/clock`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.topic_type import CLOCK, NUMBER, ODOMETRY, POINT, POSE, TEXT, TF, TWIST, VALUE, TopicType
from schemas.frames import BALL, MAP, Pose, base, pushed, to_body
from schemas.messages.command import Command
from schemas.messages.radio import Belief
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.side import Side

Write = Callable[[str, TopicType, int, Callable[[], memoryview]], None]
"""Called with topic, its type, simulated time in ns, and what encodes the message."""


class MatchMessages:
    """Writes the messages of a match.

    `cmd_vel` is the velocity that the robot's program commanded, in its body frame. Beliefs are turned from the team
    frame to the field frame. What no usual ROS message holds is JSON in a `std_msgs/String`, as on the bus.
    """

    def __init__(self, write: Write, sides: Mapping[str, Side], scoring: Sequence[Side]) -> None:
        """`sides` has the side of each robot, `scoring` the sides that score goals."""
        self._sides, self._scoring = sides, scoring
        self._cyan_attacks = 1
        self._put = write
        self._build = MessageBuilder()

    def write(self, log_ns: int, key: str, message: object, payload: bytes) -> None:
        """Write the message of this key of the bus."""
        match message:
            case World():
                self._world(log_ns, message)
            case Command():
                drive, robot = message.drive, key.split("/")[1]
                self._write(f"/{robot}/cmd_vel", TWIST, log_ns, self._build.twist(drive.vx, drive.vy, 0.0, drive.omega))
            case Belief():
                self._belief(log_ns, message, payload)
            case GameState():
                self._state(log_ns, message, payload)
            case GameEvent():
                self._text("/game/event", log_ns, payload)

    def _world(self, log_ns: int, world: World) -> None:
        """Write clock, transforms and odometry of one tick."""
        build, stamp = self._build, self._build.stamp(log_ns)
        self._write("/clock", CLOCK, log_ns, build.make(CLOCK.message, stamp))
        self._write("/tf", TF, log_ns, build.make(TF.message, list(self._transforms(stamp, world))))
        for name, robot in world.robots.items():
            self._write(f"/{name}/odom", ODOMETRY, log_ns, self._odometry(stamp, name, robot))
        if world.ball is not None:
            self._write(f"/{BALL}/odom", ODOMETRY, log_ns, self._ball(stamp, world.ball))

    def _belief(self, log_ns: int, belief: Belief, payload: bytes) -> None:
        """Write a radio message, and where the robot believes itself and the ball to be, in the field frame."""
        build, robot, radio = self._build, belief.robot, belief.radio
        header = build.header(build.stamp(log_ns), MAP)
        self._text(f"/{robot}/belief", log_ns, payload)
        side = self._sides.get(robot)
        if side is None:
            return
        attack = side.attack(self._cyan_attacks)
        if radio.self is not None:
            own = Pose(radio.self.x, radio.self.y, radio.self.heading).team(attack)
            pose = build.pose(own.x, own.y, 0.0, own.heading)
            self._write(f"/{robot}/belief/pose", POSE, log_ns, build.make(POSE.message, header, pose))
        if radio.ball is not None:
            point = build.point(attack * radio.ball.x, attack * radio.ball.y, 0.0)
            self._write(f"/{robot}/belief/ball", POINT, log_ns, build.make(POINT.message, header, point))

    def _state(self, log_ns: int, state: GameState, payload: bytes) -> None:
        """Write the state of the game, and the score as numbers."""
        self._cyan_attacks = state.cyan_attacks
        self._text("/game/state", log_ns, payload)
        if state.value is not None:
            self._write("/game/score", VALUE, log_ns, self._build.make(VALUE.message, state.value))
        for side in self._scoring:
            goals = self._build.make(NUMBER.message, getattr(state.score, side.value))
            self._write(f"/game/score/{side.value}", NUMBER, log_ns, goals)

    def _text(self, topic: str, log_ns: int, payload: bytes) -> None:
        """Write a message as JSON."""
        self._write(topic, TEXT, log_ns, self._build.make(TEXT.message, payload.decode()))

    def _transforms(self, stamp: Any, world: World) -> Iterator[Any]:
        for name, robot in world.robots.items():
            yield self._build.transform(stamp, MAP, base(name), robot.x, robot.y, robot.z, robot.heading)
        for name, one in world.obstacles.items():
            if one.pushed is not None:
                yield self._build.transform(stamp, MAP, pushed(name), one.x, one.y, 0.0, one.heading)
        if (ball := world.ball) is not None:
            yield self._build.transform(stamp, MAP, BALL, ball.x, ball.y, ball.z, 0.0)

    def _odometry(self, stamp: Any, name: str, robot: RobotTruth) -> Any:
        """Pose in `map`, twist in the body frame, as the definition of the message requires."""
        build, (vx, vy) = self._build, to_body(robot.vx, robot.vy, robot.heading)
        pose = build.pose(robot.x, robot.y, robot.z, robot.heading)
        return build.odometry(build.header(stamp, MAP), base(name), pose, build.twist(vx, vy, 0.0, robot.omega))

    def _ball(self, stamp: Any, ball: BallTruth) -> Any:
        build, pose = self._build, self._build.pose(ball.x, ball.y, ball.z, 0.0)
        return build.odometry(build.header(stamp, MAP), BALL, pose, build.twist(ball.vx, ball.vy, ball.vz, 0.0))

    def _write(self, topic: str, topic_type: TopicType, log_ns: int, message: Any) -> None:
        self._put(topic, topic_type, log_ns, lambda: self._build.encode(message, topic_type))
