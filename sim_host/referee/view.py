"""The game as one team sees it, laid out for fast encoding."""

from typing import Any

from schemas.game import Phase, TeamPhase
from schemas.side import Side
from sim_host.referee.state import RefereeState
from sim_host.snapshot import Roster

TEAM_PHASES: dict[tuple[Phase, Side | None, Side], str] = {
    (phase, taker, viewer): TeamPhase.of(phase, taker, viewer).value
    for phase in Phase
    for taker in (None, *Side)
    for viewer in Side
}
"""Phase, taker and viewer → the phase's name from the viewer's point of view."""


NOBODY: dict[str, Any] = {}


def game_view(state: RefereeState, side: Side, roster: Roster, episode: int = 1) -> dict[str, Any]:
    """The fields of a `schemas.game.GameView`; `spot` in m, in the side's team frame."""
    cyan = side is Side.CYAN
    score, spot = state.score, state.spot
    attack = state.attack(side)
    return {
        "phase": TEAM_PHASES[state.phase, state.side, side],
        "running": state.running,
        "half": state.half,
        "clock": state.clock,
        "our_score": score.cyan if cyan else score.magenta,
        "their_score": score.magenta if cyan else score.cyan,
        "stage": state.stage.value,
        "left": state.timing.left,
        "robots": _robots(state, side, roster) if state.people.records or state.people.away else NOBODY,
        "spot": None if spot is None else {"x": attack * spot[0], "y": attack * spot[1]},
        "episode": episode,
    }


def _robots(state: RefereeState, side: Side, roster: Roster) -> dict[str, Any]:
    """Those of the side's robots that have a card or are off the field."""
    mine = [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side]
    return {name: standing.model_dump(mode="json") for name, standing in state.people.standings(mine).items()}
