"""The game for viewers: a board beside the pitch with teams, score and clock, and a log of what happened."""

from recordings.viz.colours import INK, ROBOT
from recordings.viz.foxglove import LOG, encode, stamp
from recordings.viz.primitives import Values, entity, scene, text
from recordings.viz.transforms import MAP
from schemas.game import EventKind, GameEvent, GameState
from schemas.host import Setup
from schemas.side import Side

_BOARD_BESIDE, _BOARD_Z = 1.6, 1.2
"""m from the touch line, and above the ground."""
_LARGE, _SMALL = 1.1, 0.7

_LEVELS = {
    EventKind.FOUL: "WARNING",
    EventKind.CARD: "WARNING",
    EventKind.NO_GOAL: "WARNING",
    EventKind.AGENT: "WARNING",
    EventKind.FORFEIT: "ERROR",
    EventKind.PROPOSAL: "DEBUG",
}
"""How grave an event is; the others are `INFO`."""


def board(state: GameState, setup: Setup, log_ns: int) -> bytes:
    """A `foxglove.SceneUpdate`: each team's name stands at the half that it defends."""
    y = setup.pitch.touch_line + setup.pitch.border + _BOARD_BESIDE
    texts = [text((0.0, y, _BOARD_Z + _LARGE), _score(state), _LARGE, INK)]
    texts.append(text((0.0, y, _BOARD_Z - _SMALL / 2), _standing(state), _SMALL, INK))
    for side in Side:
        attacks = state.cyan_attacks if side is Side.CYAN else -state.cyan_attacks
        x = -attacks * setup.pitch.length / 4
        texts.append(text((x, y, _BOARD_Z + _LARGE), setup.teams[side].name, _LARGE, ROBOT[side]))
    return scene(log_ns, [entity("board", MAP, texts=texts)])


def log_entry(event: GameEvent, log_ns: int) -> bytes:
    """A `foxglove.Log` of an event."""
    fields: Values = {
        "timestamp": stamp(log_ns),
        "level": _LEVELS.get(event.kind, "INFO"),
        "message": event.text,
        "name": event.kind.value,
        "file": event.rule,
        "line": event.tick,
    }
    return encode(LOG, fields)


def _score(state: GameState) -> str:
    """In the order in which the teams' names stand."""
    sides = (Side.CYAN, Side.MAGENTA) if state.cyan_attacks > 0 else (Side.MAGENTA, Side.CYAN)
    return " : ".join(str(state.score.of(side)) for side in sides)


def _standing(state: GameState) -> str:
    minutes, seconds = divmod(int(state.clock), 60)
    of = f" {state.side.value}" if state.side is not None else ""
    return f"{minutes}:{seconds:02d}  {state.phase.value.replace('_', ' ')}{of}"
