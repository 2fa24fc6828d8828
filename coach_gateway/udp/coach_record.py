"""The words and numbers of the coach record that the programs of the paper's authors send, both ways. Pure.

`MatchMode` is what is played from one team's point of view. The number of a test mode has the test, and for motion also
whether the ball is taken along and whether obstacles are avoided.
"""

from enum import StrEnum
from typing import NamedTuple

from schemas.messages.coach import CoachMode, CoachTest
from schemas.side import Side
from schemas.soccer.game import ActionName, TeamPhase


class MatchMode(StrEnum):
    """What is played, from one team's point of view."""

    STOP = "stop"
    OUR_KICK_OFF = "our_kick_off"
    THEIR_KICK_OFF = "their_kick_off"
    OUR_THROW_IN = "our_throw_in"
    THEIR_THROW_IN = "their_throw_in"
    OUR_PENALTY = "our_penalty"
    THEIR_PENALTY = "their_penalty"
    OUR_GOAL_KICK = "our_goal_kick"
    THEIR_GOAL_KICK = "their_goal_kick"
    OUR_CORNER = "our_corner"
    THEIR_CORNER = "their_corner"
    OUR_FREE_KICK = "our_free_kick"
    THEIR_FREE_KICK = "their_free_kick"
    DROP_BALL = "drop_ball"
    START = "start"
    PARK = "park"
    TEST = "test"

    @property
    def number(self) -> int:
        """The number in the record."""
        return _NUMBERS[self]

    @classmethod
    def of_game(cls, phase: TeamPhase, *, running: bool) -> "MatchMode":
        """The mode of a game in that phase; before, between and after the halves it is `stop`."""
        if running or phase is TeamPhase.PLAY:
            return cls.START
        if phase is TeamPhase.PARKING:
            return cls.PARK
        return cls(phase.value) if phase.ours or phase.theirs or phase is TeamPhase.DROP_BALL else cls.STOP


_NUMBERS: dict[MatchMode, int] = {mode: number for number, mode in enumerate(MatchMode)} | {
    MatchMode.START: 15,
    MatchMode.PARK: 25,
    MatchMode.TEST: 27,
}
BY_NUMBER = {number: mode for mode, number in _NUMBERS.items()}
"""Number in the record → its mode."""


class RecordedTest(NamedTuple):
    """One of the record's test modes, as fields of an order."""

    test: CoachTest
    with_ball: bool = False
    avoid: bool = False


TEST_MODES: dict[int, RecordedTest] = {
    0: RecordedTest(CoachTest.STOP),
    2: RecordedTest(CoachTest.PASS),
    3: RecordedTest(CoachTest.CATCH),
    4: RecordedTest(CoachTest.SHOOT),
    5: RecordedTest(CoachTest.LOCATION),
    6: RecordedTest(CoachTest.CIRCLE),
    10: RecordedTest(CoachTest.MOVE),
    11: RecordedTest(CoachTest.MOVE, avoid=True),
    12: RecordedTest(CoachTest.MOVE, with_ball=True),
    13: RecordedTest(CoachTest.MOVE, with_ball=True, avoid=True),
}
"""Number → test mode."""


class Meaning(NamedTuple):
    """What a match mode requests: an action of the referee, or an order to the robots of a side."""

    action: ActionName | None = None
    side: Side | None = None
    order: CoachMode | None = None


FOR_COACH = {
    MatchMode.STOP: Meaning(order=CoachMode.HOLD),
    MatchMode.START: Meaning(order=CoachMode.PLAY),
    MatchMode.PARK: Meaning(order=CoachMode.PARK),
}
"""What match modes mean from a side's coach; the others are for the referee alone."""
_FOR_REFEREE = {
    MatchMode.STOP: Meaning(action=ActionName.STOP),
    MatchMode.START: Meaning(action=ActionName.START),
    MatchMode.DROP_BALL: Meaning(action=ActionName.DROP_BALL),
    MatchMode.PARK: Meaning(order=CoachMode.PARK),
}
"""What those mean from the referee that are the same for both sides."""


def for_referee(mode: MatchMode, own: Side) -> Meaning | None:
    """What a match mode means from the referee, from the point of view of `own`; None for a test, which is an order."""
    whose, _, what = mode.value.partition("_")
    if whose in ("our", "their"):
        return Meaning(action=ActionName(what), side=own if whose == "our" else own.opponent)
    return _FOR_REFEREE.get(mode)
