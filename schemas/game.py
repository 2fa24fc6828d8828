"""The state of the game: phases, score, events, and the actions that change it."""

from enum import StrEnum
from typing import Annotated

import msgspec
from msgspec import Meta
from pydantic import Field

from schemas.side import Side
from schemas.wire.message import Message, Name, Part, Source
from schemas.wire.struct import Struct
from schemas.wire.units import Metres, Seconds


class Phase(StrEnum):
    """What is being played; a restart belongs to the side that is given beside it."""

    PRE_GAME = "pre_game"
    STOPPED = "stopped"
    KICK_OFF = "kick_off"
    FREE_KICK = "free_kick"
    GOAL_KICK = "goal_kick"
    THROW_IN = "throw_in"
    CORNER = "corner"
    PENALTY = "penalty"
    DROP_BALL = "drop_ball"
    PLAY = "play"
    HALF_TIME = "half_time"
    PARKING = "parking"
    FULL_TIME = "full_time"


class GameStage(StrEnum):
    """Which part of the match is being played."""

    REGULAR = "regular"
    EXTRA_TIME = "extra_time"
    SHOOT_OUT = "shoot_out"


class OfficiatingMode(StrEnum):
    """Who decides: the referee, people, or the referee with people who may overrule it."""

    AUTOMATIC = "automatic"
    MANUAL = "manual"
    MIXED = "mixed"


class Card(StrEnum):
    """A card shown to a robot."""

    YELLOW = "yellow"
    RED = "red"


class OffField(StrEnum):
    """Why a robot does not take part."""

    SECOND_YELLOW = "second_yellow"
    RED_CARD = "red_card"
    REPAIR = "repair"
    SUBSTITUTION = "substitution"
    SILENT = "silent"
    PARKED = "parked"


SIDED = frozenset({Phase.KICK_OFF, Phase.FREE_KICK, Phase.GOAL_KICK, Phase.THROW_IN, Phase.CORNER, Phase.PENALTY})
"""Restarts that one side takes."""

RESTARTS = SIDED | {Phase.DROP_BALL}
"""All restarts."""


class TeamPhase(StrEnum):
    """The phase from one team's point of view."""

    PRE_GAME = "pre_game"
    STOPPED = "stopped"
    OUR_KICK_OFF = "our_kick_off"
    THEIR_KICK_OFF = "their_kick_off"
    OUR_FREE_KICK = "our_free_kick"
    THEIR_FREE_KICK = "their_free_kick"
    OUR_GOAL_KICK = "our_goal_kick"
    THEIR_GOAL_KICK = "their_goal_kick"
    OUR_THROW_IN = "our_throw_in"
    THEIR_THROW_IN = "their_throw_in"
    OUR_CORNER = "our_corner"
    THEIR_CORNER = "their_corner"
    OUR_PENALTY = "our_penalty"
    THEIR_PENALTY = "their_penalty"
    DROP_BALL = "drop_ball"
    PLAY = "play"
    HALF_TIME = "half_time"
    PARKING = "parking"
    FULL_TIME = "full_time"

    @classmethod
    def of(cls, phase: Phase, taker: Side | None, viewer: Side) -> "TeamPhase":
        """A phase that belongs to `taker`, from the point of view of `viewer`."""
        if phase not in SIDED:
            return cls(phase.value)
        return cls(f"{'our' if taker is viewer else 'their'}_{phase.value}")

    @property
    def ours(self) -> bool:
        """Whether it is our restart."""
        return self.startswith("our_")

    @property
    def theirs(self) -> bool:
        """Whether it is the opponents' restart."""
        return self.startswith("their_")


class Point(Struct, frozen=True, kw_only=True):
    """A point on the ground, in the frame that its owner names."""

    x: Metres
    """x in the frame of its owner, in m."""
    y: Metres
    """y in the frame of its owner, in m."""


class Score(Part):
    """Goals of both sides."""

    cyan: Annotated[int, Field(ge=0)] = 0
    """Goals of cyan."""
    magenta: Annotated[int, Field(ge=0)] = 0
    """Goals of magenta."""

    def of(self, side: Side) -> int:
        """The goals of a side."""
        return self.cyan if side is Side.CYAN else self.magenta

    def plus(self, side: Side, goals: int = 1) -> "Score":
        """The same score with more goals for a side."""
        added = {side.value: self.of(side) + goals}
        return Score(**{other.value: self.of(other) for other in Side} | added)


class DisciplinaryRecord(Struct, frozen=True, kw_only=True):
    """The cards of one robot, and whether it is off the field."""

    yellow: Annotated[int, Meta(ge=0)] = 0
    """Yellow cards that count toward the next punishment."""
    red: Annotated[int, Meta(ge=0)] = 0
    """Red cards."""
    off_field: OffField | None = None
    """Why the robot does not take part; None while it does."""
    left: Seconds | None = None
    """Time until the robot may return, at the next stoppage, in s; None on the field, and where it may not return."""


class GameState(Message):
    """The state of the game, in the field frame."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    phase: Phase
    """What is being played; a restart belongs to `side`."""
    side: Side | None = None
    """The side that takes the restart; None where no side does."""
    running: bool = False
    """START was given; before that, robots take their positions and may not play the ball."""
    half: Annotated[int, Field(ge=1)] = 1
    """The half that is being played; counts on through extra time."""
    stage: GameStage = GameStage.REGULAR
    """Regular time, extra time, or the penalty shoot-out."""
    clock: float = 0.0
    """Game clock in s: playing time of this half and those before it."""
    effective: float = 0.0
    """Effective playing time in s: how long the ball has been in play."""
    score: Score = Score()
    """Goals without those of a penalty shoot-out."""
    shoot_out: Score | None = None
    """Goals of the penalty shoot-out, during and after it; None without one."""
    cyan_attacks: Annotated[int, Field(ge=-1, le=1)] = 1
    """Sign of the x direction that cyan attacks."""
    spot: Point | None = None
    """Where the ball is placed for the restart, in the field frame; None where the referee has set no spot."""
    left: float | None = None
    """Time in s until the limit of the current phase (START, ball in play, end of a break or of a shoot-out's attempt);
    None without one."""
    robots: dict[Name, DisciplinaryRecord] = Field(default_factory=dict)
    """Robot → its cards, and why it is off the field; robots without either are left out."""
    proposal: str | None = None
    """Mixed officiating: what the referee has proposed and not yet carried out; None without a proposal."""
    episode: int = 1
    """Counts the starts of the world: the match's own, each scene that is loaded, each reset."""


class GameView(Struct, frozen=True, kw_only=True):
    """The state of the game from one team's point of view."""

    phase: TeamPhase
    """What is being played, and whose restart it is."""
    running: bool
    """START was given; before that, robots take their positions and may not play the ball."""
    half: int = 1
    """The half that is being played; counts on through extra time."""
    clock: Seconds
    """Game clock in s: playing time of this half and those before it."""
    our_score: int
    """Our goals, without those of a penalty shoot-out."""
    their_score: int
    """Their goals, without those of a penalty shoot-out."""
    spot: Point | None = None
    """Where the ball is placed for the restart, in the team frame; None where the referee has set no spot."""
    stage: GameStage = GameStage.REGULAR
    """Regular time, extra time, or the penalty shoot-out."""
    left: Seconds | None = None
    """Time in s until the limit of the current phase (START, ball in play, end of a break or of a shoot-out's attempt);
    None without one."""
    robots: dict[Name, DisciplinaryRecord] = msgspec.field(default_factory=dict)
    """Our robot → its cards, and why it is off the field; robots without either are left out."""
    episode: int = 1
    """Counts the starts of the world. When the number changes, the world was set up anew, and earlier beliefs are
    void."""


class EventKind(StrEnum):
    """What happened."""

    STOP = "stop"
    RESTART = "restart"
    START = "start"
    IN_PLAY = "in_play"
    GOAL = "goal"
    NO_GOAL = "no_goal"
    SHOT = "shot"
    FOUL = "foul"
    CARD = "card"
    OFF_FIELD = "off_field"
    ON_FIELD = "on_field"
    PROPOSAL = "proposal"
    BALL_OUT = "ball_out"
    STALL = "stall"
    PARKING = "parking"
    HALF_TIME = "half_time"
    FORFEIT = "forfeit"
    FULL_TIME = "full_time"
    ACTION = "action"
    AGENT = "agent"
    PARAMETERS = "parameters"
    SCENE = "scene"


class GameEvent(Message):
    """Something that happened, with its rule, place, robots and measured quantity."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    clock: float
    """Game clock in s."""
    kind: EventKind
    """What happened."""
    rule: str
    """Name of the rule or action that caused it."""
    side: Side | None = None
    """The side that it concerns; None where it concerns neither or both."""
    robot: Name | None = None
    """The robot that caused it: the scorer, the last to touch the ball, the offender."""
    robots: list[Name] = Field(default_factory=list)
    """All robots that it concerns, where there is more than one."""
    place: Point | None = None
    """Where it happened, in the field frame; None where it has no place."""
    score: Score | None = None
    """The score after it; None where the score did not change."""
    measured: float | None = None
    """The measured quantity, in `unit`; None where the rule measures none."""
    limit: float | None = None
    """The limit that the rule sets for it, in `unit`; None where the rule measures none."""
    unit: str = ""
    """Unit of `measured` and `limit`; empty without them."""
    card: Card | None = None
    """The card that was shown; None without one."""
    text: str
    """One sentence for display, with the measured quantity where there is one."""


class ActionName(StrEnum):
    """What a human referee, a coach or the referee box may request."""

    START = "start"
    STOP = "stop"
    KICK_OFF = "kick_off"
    FREE_KICK = "free_kick"
    GOAL_KICK = "goal_kick"
    THROW_IN = "throw_in"
    CORNER = "corner"
    PENALTY = "penalty"
    DROP_BALL = "drop_ball"
    PLACE_BALL = "place_ball"
    GOAL = "goal"
    CANCEL_GOAL = "cancel_goal"
    YELLOW_CARD = "yellow_card"
    RED_CARD = "red_card"
    REPAIR = "repair"
    SUBSTITUTE = "substitute"
    PARK = "park"
    ENTER = "enter"
    CONFIRM = "confirm"
    OVERRULE = "overrule"
    UNDO = "undo"
    END_HALF = "end_half"
    END_GAME = "end_game"


REFBOX = "refbox"
"""The source of requests from a league's referee box, and the kind of its liveliness token."""


class RefereeAction(Message):
    """A request to the referee; accepted, or refused with the reason."""

    action: ActionName
    """The requested action."""
    side: Side | None = None
    """The side that it concerns; None for actions without a side."""
    robot: Name | None = None
    """The scorer of a goal; the robot that a card, a repair, a substitution or an entry concerns."""
    place: Point | None = None
    """Place of the action in the field frame, from which a restart takes its spot; by default where the ball lies."""
    source: Source = "coach"
    """Name of the sender, for display."""


class ActionReply(Message):
    """The referee's reply to an action."""

    accepted: bool
    """The action was carried out."""
    reason: str = ""
    """Why it was refused; empty where it was accepted."""
    tick: int | None = None
    """Tick in which the referee judged the action; the state of that tick is published before the reply. None where
    the request did not reach the referee."""
