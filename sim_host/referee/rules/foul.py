"""What all fouls share: whether the rule book calls them, what the event says, and which restart follows from where.

The referee stops at once and plays no advantage: that is left to people, who may undo.
"""

from schemas.game import Card, EventKind, Phase
from schemas.side import Side
from sim_host.referee.game.decision import Decision
from sim_host.referee.game.timing import ROUNDING
from sim_host.referee.placement.spots import restart_at
from sim_host.referee.situation import Situation

CARDS = {"on": None, "yellow": Card.YELLOW}
"""The rule book's word → the card that goes with the restart."""


def exceeds(measured: float, limit: float) -> bool:
    """Whether a measure is beyond its limit, and not by the rounding of a sum of ticks alone."""
    return measured > limit + ROUNDING


def is_called(situation: Situation, name: str) -> bool:
    """Whether the rule book has the foul of that name called at all."""
    word: str = getattr(situation.match.book.fouls, name)
    return word != "off"


def foul(
    situation: Situation,
    name: str,
    offenders: tuple[str, ...],
    text: str,
    *,
    measured: float,
    limit: float,
    unit: str,
    place: tuple[float, float],
    phase: Phase = Phase.FREE_KICK,
    restart_from: tuple[float, float] | None = None,
) -> Decision:
    """The decision on a foul: the other side's restart from where the ball is, the first offender's card.

    Args:
        scene: the tick it is found in.
        name: of the foul in the rule book's section `fouls`.
        offenders: robots of one side, the one that is shown a card first.
        text: what they did, with quantity and limit.
        measured: the quantity that broke the rule, in `unit`.
        limit: what the rule book allows, in `unit`.
        unit: of both.
        place: m; where it happened.
        phase: the restart.
        restart_from: m; the place that its spot follows from, when that is not the ball's.
    """
    side = situation.match.roster.side_of(offenders[0])
    ball = situation.snapshot.ball
    start = restart_from if restart_from is not None else (ball.x, ball.y)
    return Decision(
        kind=EventKind.FOUL,
        text=f"{text}; no advantage is played",
        restart=restart_at(situation.match, situation.state, phase, side.opponent, start),
        side=side,
        robot=offenders[0],
        robots=offenders if len(offenders) > 1 else (),
        place=place,
        measured=measured,
        limit=limit,
        unit=unit,
        card=CARDS[getattr(situation.match.book.fouls, name)],
    )


def is_own_half(situation: Situation, side: Side, x: float) -> bool:
    """Whether a ball whose centre is at `x` lies wholly in the half that a side defends."""
    return x * situation.state.attack(side) < -situation.match.ball.radius
