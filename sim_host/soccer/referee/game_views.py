"""The game as each team sees it, which both teams receive in every tick."""

from schemas.messages.soccer.game import GameView
from schemas.side import Side
from schemas.soccer.game import Phase, Point, TeamPhase
from sim_host.snapshot import Roster
from sim_host.soccer.referee.game.referee_state import RefereeState

TEAM_PHASES: dict[tuple[Phase, Side | None, Side], TeamPhase] = {
    (phase, taker, viewer): TeamPhase.of(phase, taker, viewer)
    for phase in Phase
    for taker in (None, *Side)
    for viewer in Side
}
"""Phase, taker and viewer → the phase from the viewer's point of view."""


def game_views(state: RefereeState, roster: Roster, episode: int = 1) -> dict[Side, GameView]:
    """Side → the game from its point of view; `spot` in m, in the side's team frame."""
    score, timing, participation, spot = state.score, state.timing, state.participation, state.spot
    booked = bool(participation.cards or participation.absences)
    views = {}
    for side, ours, theirs in (
        (Side.CYAN, score.cyan, score.magenta),
        (Side.MAGENTA, score.magenta, score.cyan),
    ):
        attack = state.attack(side)
        mine = [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side] if booked else []
        views[side] = GameView(
            phase=TEAM_PHASES[state.phase, state.side, side],
            running=state.running,
            half=state.half,
            clock=timing.clock,
            our_score=ours,
            their_score=theirs,
            spot=None if spot is None else Point(x=attack * spot[0] + 0.0, y=attack * spot[1] + 0.0),  # 0, never -0
            stage=state.stage,
            left=timing.left,
            robots=participation.disciplinary_records(mine),
            episode=episode,
        )
    return views
