"""Common parts of the rules on taking a restart: when they judge, and the restart after a foul."""

from schemas.game import Phase
from sim_host.referee.game.restart import Restart
from sim_host.referee.game.set_piece import SetPiece
from sim_host.referee.placement.spots import restart_at
from sim_host.referee.situation import Situation

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
