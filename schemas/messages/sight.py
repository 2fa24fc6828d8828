"""What one robot knows at one tick, in its team frame: each team attacks +x in its own frame."""

from copy import deepcopy
from typing import ClassVar, Self

from msgspec.structs import replace

from schemas.config.sensors.table import Reading
from schemas.messages.coach import CoachOrder
from schemas.messages.radio import BallBelief, Motion, RadioContent
from schemas.messages.soccer.game import GameView
from schemas.side import Side
from schemas.wire.message import WITHOUT_SENSORS, Message, Name
from schemas.wire.part import Part
from schemas.wire.units import Metres, MetresPerSecond, Seconds


class BallSight(Part):
    """The ball as the camera last saw it."""

    x: Metres
    """x of the ball's centre in the team frame, in m."""
    y: Metres
    """y of the ball's centre in the team frame, in m."""
    z: Metres | None = None
    """Height of the ball's centre above the ground, in m; None where the camera does not measure it."""
    vx: MetresPerSecond
    """Velocity along x of the team frame, in m/s."""
    vy: MetresPerSecond
    """Velocity along y of the team frame, in m/s."""
    age: Seconds = 0.0
    """Simulated time since the picture was taken that these values come from, in s."""
    visible: bool = True
    """The ball is in the newest picture. Otherwise it is out of range, hidden or not detected, and the other fields are
    those of the last picture that it was in."""


class Obstacle(Part, kw_only=False):
    """A round body in the camera's picture; the picture does not identify it."""

    x: Metres
    """x of its centre in the team frame, in m."""
    y: Metres
    """y of its centre in the team frame, in m."""
    radius: Metres
    """Radius of the circle around it on the ground, in m."""


class ReceivedRadio(RadioContent):
    """A teammate's radio message as it was delivered."""

    age: Seconds
    """Simulated time from the moment at which it left the sender to this sight, in s, to 0.1 ms.

    Its content answers the sender's sight of up to one tick before it left.
    """

    @classmethod
    def of(cls, content: RadioContent, age: float = 0.0) -> "ReceivedRadio":
        """The parts of a radio message that teammates receive, sent `age` s ago."""
        return cls(age=age, **{name: getattr(content, name) for name in RadioContent.__struct_fields__})


class Outcome(Part):
    """What became of the robot's last command."""

    answers_tick: int | None = None
    """Tick of the sight that the command answered; None where no command arrived for this tick."""
    refused: list[str] = []
    """One sentence with the reason for each part of the command that was not carried out."""


class Sight(Message):
    """What one robot perceives at one tick."""

    omitted: ClassVar[bytes] = WITHOUT_SENSORS

    tick: int
    """Control ticks since the match began."""
    time: Seconds
    """Simulated time in s: tick × control tick."""
    robot: Name
    """Name of the robot that perceives this."""
    side: Side
    """The robot's side."""
    self: Motion
    """The robot's own pose and twist, as it measures them."""
    ball: BallSight | None
    """The ball as the camera last saw it; None until it is seen for the first time."""
    holding: bool
    """The robot holds the ball: only then can it kick."""
    kicker_ready: bool = True
    """The kicker is charged; otherwise a kick is refused."""
    stuck: bool = False
    """The robot has moved much slower than commanded for a while: something is in its way."""
    obstacles: list[Obstacle]
    """Robots of both teams and other bodies in the newest picture, the nearest first."""
    obstacles_age: Seconds = 0.0
    """Simulated time since that picture was taken, in s."""
    radio: dict[Name, ReceivedRadio] = {}
    """Teammate → its newest radio message that was delivered."""
    game: GameView
    """The state of the game from the team's point of view."""
    order: CoachOrder | None = None
    """The coach's order in force; None without one."""
    outcome: Outcome = Outcome()
    """What became of the robot's last command."""
    sensors: dict[Name, Reading] = {}
    """Sensor of the profile → its newest reading; omitted for a robot without sensors."""

    def own_copy(self) -> Self:
        """The same sight, with lists and mappings that no other has: its reader may change them."""
        return replace(
            self,
            obstacles=[*self.obstacles],
            radio={name: replace(message, extra={**message.extra}) for name, message in self.radio.items()},
            game=replace(self.game, robots={**self.game.robots}),
            outcome=replace(self.outcome, refused=[*self.outcome.refused]),
            sensors=deepcopy(self.sensors) if self.sensors else {},
        )


__all__ = ["BallBelief", "BallSight", "Motion", "Obstacle", "Outcome", "ReceivedRadio", "Sight"]
