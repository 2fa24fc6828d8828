"""Common parts of all fouls: whether the rule book calls them, the text of the event, and the restart.

The referee stops the game at once, unless it plays an advantage. People may undo the decision.
"""

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.restart import Spot
from sim_host.soccer.referee.game.timing import ROUNDING
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.situation import Situation

CARDS = {"on": None, "yellow": Card.YELLOW}
"""The rule book's choice → the card that goes with the restart."""
Figures = tuple[float | None, float | None, str]
"""The quantity that broke a rule, its limit, and the unit of both; None for a rule without a quantity."""


def exceeds(measured: float, limit: float) -> bool:
    """Whether a measured quantity exceeds its limit by more than the rounding of a sum of ticks."""
    return measured > limit + ROUNDING


def is_called(situation: Situation, name: str) -> bool:
    """Whether the rule book calls the foul of that name."""
    choice: str = getattr(situation.match.book.fouls, name)
    return choice != "off"


def foul(
    situation: Situation,
    name: str,
    offenders: tuple[str, ...],
    text: str,
    figures: Figures,
    place: Spot | None = None,
    *,
    phase: Phase = Phase.FREE_KICK,
    restart_from: Spot | None = None,
    card: Card | None = None,
) -> Decision:
    """The decision on a foul: a restart for the other side where the ball is, and a card for the first offender.

    Args:
        situation: the tick in which the foul was found.
        name: name of the foul in the rule book's section `fouls`.
        offenders: robots of one side, the one that is shown a card first.
        text: what they did, with quantity and limit.
        figures: the quantity that broke the rule, the limit of the rule book, and their unit.
        place: m; where it happened, if not where the ball is.
        phase: the restart.
        restart_from: m; the place that determines the spot of the restart, if not the ball's.
        card: the card that the deed itself earns; otherwise the rule book's choice for the foul.
    """
    side = situation.match.roster.side_of(offenders[0])
    measured, limit, unit = figures
    remark = "" if situation.match.advantage else "; no advantage is played"
    return Decision(
        kind=EventKind.FOUL,
        text=text + remark,
        restart=restart_at(situation.match, situation.state, phase, side.opponent, restart_from or situation.ball_spot),
        side=side,
        robot=offenders[0],
        robots=offenders if len(offenders) > 1 else (),
        place=place or situation.ball_spot,
        measured=measured,
        limit=limit,
        unit=unit,
        card=card or CARDS[getattr(situation.match.book.fouls, name)],
    )


def is_own_half(situation: Situation, side: Side, x: float) -> bool:
    """Whether a ball whose centre is at `x` is wholly in the half that a side defends."""
    return x * situation.state.attack(side) < -situation.match.ball.radius
