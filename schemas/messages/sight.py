"""Everything one robot knows at one tick, in its team frame: each team believes it attacks +x."""

from pydantic import Field

from schemas.game import GameView
from schemas.message import Message, Name, Part
from schemas.messages.coach import CoachOrder
from schemas.messages.command import BallBelief, Motion, Radio
from schemas.side import Side


class BallSight(Part):
    """The ball as the camera saw it last: m, m/s; `age` in s since that picture was taken."""

    x: float
    y: float
    z: float | None = None
    vx: float
    vy: float
    age: float = 0.0
    visible: bool = True
    """It is in the newest picture; otherwise it is too far away, hidden or overlooked, and this is its last place."""


class Obstacle(Part):
    """Something round in the way: m. Whose robot it is, or whether it is one, the robot has to find out."""

    x: float
    y: float
    radius: float


class ReceivedRadio(Radio):
    """A teammate's word, and how long ago it was said, in s."""

    age: float


class Outcome(Part):
    """What became of the robot's last command: `refused` holds one sentence for each part that was not done."""

    answers_tick: int | None = None
    """The sight that the command answered; nothing when none arrived for this tick."""
    refused: list[str] = Field(default_factory=list)
    """What was not done, and why."""


class Sight(Message):
    """What one robot perceives at one tick."""

    tick: int
    time: float
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
    obstacles_age: float = 0.0
    """Since that picture was taken, in s."""
    radio: dict[Name, ReceivedRadio] = Field(default_factory=dict)
    """The newest word of each teammate."""
    game: GameView
    order: CoachOrder | None = None
    """The coach's newest."""
    outcome: Outcome = Outcome()


__all__ = ["BallBelief", "BallSight", "Motion", "Obstacle", "Outcome", "ReceivedRadio", "Sight"]
