"""The signals of the referee box: their names since 2020, their earlier characters, and their effect on the game."""

from dataclasses import dataclass

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, GameStage, Phase


@dataclass(frozen=True, slots=True)
class Signal:
    """One signal."""

    name: str
    """Name in the protocol since 2020."""
    character: str
    """Character in the earlier protocol; for a signal to a side cyan's; lower case for magenta."""
    kind: EventKind
    description: str
    sided: bool = False
    """It is for a side."""
    phase: Phase | None = None
    """The phase that it begins."""
    goals: int = 0
    """Goals that it adds to the side's score."""
    card: Card | None = None
    half: int = 0
    """The half that it begins; 0 for none."""
    stage: GameStage = GameStage.REGULAR

    def character_for(self, side: Side | None) -> str:
        """The character for a side; empty for signals that only JSON has."""
        return self.character.lower() if self.sided and side is Side.MAGENTA else self.character


START = Signal("START", "s", EventKind.START, "START", phase=Phase.PLAY)
STOP = Signal("STOP", "S", EventKind.STOP, "STOP", phase=Phase.STOPPED)
GOAL = Signal("GOAL", "A", EventKind.GOAL, "Goal+", True, goals=1)
SUBGOAL = Signal("SUBGOAL", "D", EventKind.ACTION, "Goal-", True, goals=-1)
HALF_TIME = Signal("HALF_TIME", "h", EventKind.HALF_TIME, "Halftime", phase=Phase.HALF_TIME)
END_GAME = Signal("END_GAME", "e", EventKind.FULL_TIME, "End Game", phase=Phase.FULL_TIME)

SIGNALS: tuple[Signal, ...] = (
    START,
    STOP,
    Signal("KICKOFF", "K", EventKind.RESTART, "Kickoff", True, Phase.KICK_OFF),
    Signal("FREEKICK", "F", EventKind.RESTART, "Freekick", True, Phase.FREE_KICK),
    Signal("GOALKICK", "G", EventKind.RESTART, "Goalkick", True, Phase.GOAL_KICK),
    Signal("THROWIN", "T", EventKind.RESTART, "Throw In", True, Phase.THROW_IN),
    Signal("CORNER", "C", EventKind.RESTART, "Corner", True, Phase.CORNER),
    Signal("PENALTY", "P", EventKind.RESTART, "Penalty Kick", True, Phase.PENALTY),
    Signal("DROP_BALL", "N", EventKind.RESTART, "Drop Ball", phase=Phase.DROP_BALL),
    GOAL,
    SUBGOAL,
    Signal("YELLOW_CARD", "Y", EventKind.CARD, "Yellow Card", True, card=Card.YELLOW),
    Signal("DOUBLE_YELLOW", "B", EventKind.CARD, "Double Yellow", True, card=Card.YELLOW),
    Signal("RED_CARD", "R", EventKind.CARD, "Red Card", True, card=Card.RED),
    Signal("REPAIR", "O", EventKind.OFF_FIELD, "Repair Out", True),
    Signal("REPAIR_END", "I", EventKind.ON_FIELD, "Repair In", True),
    Signal("SUBSTITUTION", "", EventKind.OFF_FIELD, "Substitution", True),
    Signal("PARK", "L", EventKind.PARKING, "Park", phase=Phase.PARKING),
    Signal("FIRST_HALF", "1", EventKind.ACTION, "1st half", half=1),
    Signal("SECOND_HALF", "2", EventKind.ACTION, "2nd half", half=2),
    Signal("FIRST_HALF_OVERTIME", "3", EventKind.ACTION, "Overtime 1st half", half=3, stage=GameStage.EXTRA_TIME),
    Signal("SECOND_HALF_OVERTIME", "4", EventKind.ACTION, "Overtime 2nd half", half=4, stage=GameStage.EXTRA_TIME),
    HALF_TIME,
    Signal("END_PART", "", EventKind.HALF_TIME, "End Part", phase=Phase.HALF_TIME),
    END_GAME,
    Signal("GAMEOVER", "z", EventKind.FULL_TIME, "Game Over", phase=Phase.FULL_TIME),
    Signal("WELCOME", "W", EventKind.ACTION, "Welcome"),
    Signal("RESET", "Z", EventKind.ACTION, "Reset"),
    Signal("TESTMODE_ON", "U", EventKind.ACTION, "Test mode on"),
    Signal("TESTMODE_OFF", "u", EventKind.ACTION, "Test mode off"),
    Signal("IS_ALIVE", "", EventKind.ACTION, "Is alive", True),
    Signal("HALT", "H", EventKind.STOP, "Halt", phase=Phase.STOPPED),
    Signal("READY", " ", EventKind.ACTION, "Ready"),
    Signal("CANCEL", "x", EventKind.ACTION, "Cancel"),
    Signal("RESTART", "n", EventKind.ACTION, "Restart"),
)

BY_NAME = {signal.name: signal for signal in SIGNALS}
BY_NAME["GAME_OVER"] = BY_NAME["GAMEOVER"]  # the spelling in the league's document
BY_CHARACTER: dict[str, tuple[Signal, Side | None]] = {
    signal.character: (signal, Side.CYAN if signal.sided else None) for signal in SIGNALS if signal.character
} | {signal.character.lower(): (signal, Side.MAGENTA) for signal in SIGNALS if signal.sided and signal.character}
BY_DESCRIPTION = {signal.description.lower(): signal for signal in SIGNALS} | {
    "penalty": BY_NAME["PENALTY"],
    "repair": BY_NAME["REPAIR"],
    "repair ended": BY_NAME["REPAIR_END"],
    "reset game": BY_NAME["RESET"],
}
"""Description in lower case → its signal, as the present box logs it."""
RESTART_OF = {signal.phase: signal for signal in SIGNALS if signal.kind is EventKind.RESTART}
"""Phase of a restart → its signal."""
HALF_OF = {signal.half: signal for signal in SIGNALS if signal.half}
"""Number of a half → the signal that begins it."""
