"""Everything one robot knows at one tick, in its team frame: each team believes it attacks +x."""

from msgspec import field

from schemas.game import GameView
from schemas.message import Name
from schemas.messages.coach import CoachOrder
from schemas.messages.command import BallBelief, Motion, RadioContent
from schemas.side import Side
from schemas.struct import Struct, StructMessage
from schemas.units import Metres, MetresPerSecond, Seconds


class BallSight(Struct, frozen=True, kw_only=True):
    """The ball as the camera saw it last: m, m/s; `age` in s since that picture was taken."""

    x: Metres
    y: Metres
    z: Metres | None = None
    vx: MetresPerSecond
    vy: MetresPerSecond
    age: Seconds = 0.0
    visible: bool = True
    """It is in the newest picture; otherwise it is too far away, hidden or overlooked, and this is its last place."""


class Obstacle(Struct, frozen=True, kw_only=True):
    """Something round in the way: m. Whose robot it is, or whether it is one, the robot has to find out."""

    x: Metres
    y: Metres
    radius: Metres


class ReceivedRadio(RadioContent, frozen=True, kw_only=True):
    """A teammate's word, and how long ago it was said, in s."""

    age: Seconds


class Outcome(Struct, frozen=True, kw_only=True):
    """What became of the robot's last command: `refused` holds one sentence for each part that was not done."""

    answers_tick: int | None = None
    """The sight that the command answered; nothing when none arrived for this tick."""
    refused: list[str] = field(default_factory=list)
    """What was not done, and why."""


class Sight(StructMessage, frozen=True, kw_only=True):
    """What one robot perceives at one tick."""

    tick: int
    time: Seconds
    """Simulated time in s."""
    robot: Name
    """Who perceives this."""
    side: Side
    self: Motion
    """Own pose and twist, as the robot measures them."""
    ball: BallSight | None
    """Nothing when the ball was never seen."""
    holding: bool
    """The ball is in hand: only then can it be kicked."""
    kicker_ready: bool = True
    """The kicker is charged: otherwise a kick is refused."""
    stuck: bool = False
    """For long it has moved much slower than it was told: something is in its way."""
    obstacles: list[Obstacle]
    """Robots of both teams and other bodies in the newest picture, the nearest first."""
    obstacles_age: Seconds = 0.0
    """Since that picture was taken, in s."""
    radio: dict[Name, ReceivedRadio] = field(default_factory=dict)
    """The newest word of each teammate."""
    game: GameView
    order: CoachOrder | None = None
    """The coach's newest."""
    outcome: Outcome = Outcome()


__all__ = ["BallBelief", "BallSight", "Motion", "Obstacle", "Outcome", "ReceivedRadio", "Sight"]
