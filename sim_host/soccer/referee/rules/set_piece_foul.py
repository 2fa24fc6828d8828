"""Common parts of the rules on taking a restart: when they judge, and the decision on a foul."""

from schemas.soccer.game import Card, EventKind, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.game.set_piece import SetPiece
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.rules.foul import Figures
from sim_host.soccer.referee.situation import Situation

KEPT = frozenset({Phase.KICK_OFF, Phase.THROW_IN})
"""Restarts that keep their kind when the other side gets them; the others become free kicks."""


def being_taken(situation: Situation) -> SetPiece | None:
    """The started restart that is not in play yet, or None; None also if the rule book has no restart fouls."""
    state = situation.state
    piece = state.set_piece
    if piece is None or state.phase is Phase.PLAY:
        return None
    numbers = situation.match.book.restarts
    return piece if numbers.restart_fouls and piece.rolled < numbers.in_play_distance else None


def given_away(situation: Situation, piece: SetPiece) -> Restart:
    """The restart for the other side."""
    restart = piece.restart
    if restart.side is None:
        return restart
    phase = restart.phase if restart.phase in KEPT else Phase.FREE_KICK
    return restart_at(situation.match, situation.state, phase, restart.side.opponent, restart.spot)


def restart_foul(
    situation: Situation,
    name: str,
    text: str,
    restart: Restart,
    figures: Figures,
    place: Spot | None = None,
    card: Card | None = None,
) -> Decision:
    """The decision on a foul of a robot at a restart; `place` in m is where the ball is by default."""
    measured, limit, unit = figures
    return Decision(
        kind=EventKind.FOUL,
        text=text,
        restart=restart,
        side=situation.match.roster.side_of(name),
        robot=name,
        place=place or situation.ball_spot,
        measured=measured,
        limit=limit,
        unit=unit,
        card=card,
    )
