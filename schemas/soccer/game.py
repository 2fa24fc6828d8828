"""The vocabulary of the game: phases, cards, score, events and actions."""

from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.side import Side
from schemas.wire.part import Part
from schemas.wire.units import Metres


class Phase(StrEnum):
    """What is being played; a restart belongs to the side that is given with it."""

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


class Point(Part):
    """A point on the ground, in the frame that its owner names."""

    x: Metres
    """x in the frame of its owner, in m."""
    y: Metres
    """y in the frame of its owner, in m."""


class Score(Part):
    """Goals of both sides."""

    cyan: Annotated[int, Meta(ge=0)] = 0
    """Goals of cyan."""
    magenta: Annotated[int, Meta(ge=0)] = 0
    """Goals of magenta."""

    def of(self, side: Side) -> int:
        """The goals of a side."""
        return self.cyan if side is Side.CYAN else self.magenta

    def plus(self, side: Side, goals: int = 1) -> "Score":
        """The same score with more goals for a side."""
        added = {side.value: self.of(side) + goals}
        return Score(**{other.value: self.of(other) for other in Side} | added)


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
    ADVANTAGE = "advantage"
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
    NOTE = "note"
    AGENT = "agent"
    PARAMETERS = "parameters"
    SCENE = "scene"


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
    DOUBLE_YELLOW = "double_yellow"
    RED_CARD = "red_card"
    REPAIR = "repair"
    SUBSTITUTE = "substitute"
    PARK = "park"
    ENTER = "enter"
    NAME_ROBOT = "name_robot"
    CONFIRM = "confirm"
    OVERRULE = "overrule"
    UNDO = "undo"
    END_HALF = "end_half"
    END_GAME = "end_game"


REFBOX = "refbox"
"""The source of requests from a league's referee box, and the kind of its liveliness token."""
