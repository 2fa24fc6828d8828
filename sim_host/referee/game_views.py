"""The game as each team sees it, written as JSON: both teams are told in every tick."""

from pydantic_core import to_json

from schemas.game import Phase, TeamPhase
from schemas.side import Side
from sim_host.referee.game.referee_state import RefereeState
from sim_host.referee.game.restart import Spot
from sim_host.snapshot import Roster

TEAM_PHASES: dict[tuple[Phase, Side | None, Side], bytes] = {
    (phase, taker, viewer): TeamPhase.of(phase, taker, viewer).value.encode()
    for phase in Phase
    for taker in (None, *Side)
    for viewer in Side
}
"""Phase, taker and viewer → the phase's name from the viewer's point of view."""

_JSON = {True: b"true", False: b"false"}
_FORM = b'{"phase":"%b",%b,"our_score":%d,"their_score":%d,%b,"robots":%b,"spot":%b,"episode":%d}'
_TIME = b'"running":%b,"half":%d,"clock":%b'
_WAIT = b'"stage":"%b","left":%b'


def game_views(state: RefereeState, roster: Roster, episode: int = 1) -> dict[Side, bytes]:
    """Side → its `schemas.game.GameView`; `spot` in m, in the side's team frame."""
    score, left, participation = state.score, state.timing.left, state.participation
    time = _TIME % (_JSON[state.running], state.half, repr(state.timing.clock).encode())
    wait = _WAIT % (state.stage.encode(), b"null" if left is None else repr(left).encode())
    return {
        side: _FORM
        % (
            TEAM_PHASES[state.phase, state.side, side],
            time,
            ours,
            theirs,
            wait,
            _robots(state, side, roster) if participation.cards or participation.absences else b"{}",
            b"null" if state.spot is None else _spot(state.spot, state.attack(side)),
            episode,
        )
        for side, ours, theirs in (
            (Side.CYAN, score.cyan, score.magenta),
            (Side.MAGENTA, score.magenta, score.cyan),
        )
    }


def _spot(spot: Spot, attack: int) -> bytes:
    return to_json({"x": attack * spot[0], "y": attack * spot[1]})


def _robots(state: RefereeState, side: Side, roster: Roster) -> bytes:
    """Those of the side's robots that have a card or are off the field."""
    mine = [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side]
    return to_json(state.participation.disciplinary_records(mine))
