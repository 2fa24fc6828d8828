"""The game for viewers: a board beside the pitch with teams, score and clock, and a log of events."""

from foxglove_schemas_protobuf.Log_pb2 import Log

from recordings.viz.colours import INK, TEAM_TEXT
from recordings.viz.foxglove import set_time
from recordings.viz.primitives import encode_scene, entity, scene_update, text
from schemas.config.task import score_text
from schemas.frames import MAP
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from schemas.soccer.game import EventKind

_BOARD_GAP, _BOARD_Z = 0.8, 0.8
"""m from the boundary, and above the ground."""
_ROWS = 1.3
"""m from one row to the next, backward and upward: rows are separate when seen from the side and from above."""
_LARGE, _SMALL = 1.1, 0.7

_LEVELS = {
    EventKind.FOUL: Log.WARNING,
    EventKind.ADVANTAGE: Log.WARNING,
    EventKind.CARD: Log.WARNING,
    EventKind.NO_GOAL: Log.WARNING,
    EventKind.AGENT: Log.WARNING,
    EventKind.FORFEIT: Log.ERROR,
    EventKind.PROPOSAL: Log.DEBUG,
}
"""Log levels of events; all others are `INFO`."""


def scoreboard(state: GameState, setup: Setup, log_ns: int) -> bytes:
    """A `foxglove.SceneUpdate` with each team's name beside the half that it defends."""
    y, z = setup.pitch.touch_line + setup.pitch.border + _BOARD_GAP, _BOARD_Z
    texts = [
        text((0.0, y, z), _phase_text(state), _SMALL, INK),
        text((0.0, y + _ROWS, z + _ROWS), _score_text(state, setup), _LARGE, INK),
    ]
    for side in Side:
        if not setup.teams[side].robots:
            continue
        attacks = state.cyan_attacks if side is Side.CYAN else -state.cyan_attacks
        x = -attacks * setup.pitch.length / 4
        texts.append(text((x, y + _ROWS, z + _ROWS), setup.teams[side].name, _LARGE, TEAM_TEXT[side]))
    return encode_scene(scene_update([entity("board", MAP, texts=texts)]), log_ns)


def log_entry(event: GameEvent, log_ns: int) -> bytes:
    """A `foxglove.Log` of an event."""
    entry = Log(
        level=_LEVELS.get(event.kind, Log.INFO),
        message=event.text,
        name=event.kind.value,
        file=event.rule,
        line=event.tick,
    )
    set_time(entry.timestamp, log_ns)
    return entry.SerializeToString()


def _score_text(state: GameState, setup: Setup) -> str:
    """The goals, in the order of the teams' names on the board; the score of a task with its unit."""
    task = score_text(state.value, setup.task.unit) if setup.task is not None else ""
    if setup.free is not None:
        return task
    sides = (Side.CYAN, Side.MAGENTA) if state.cyan_attacks > 0 else (Side.MAGENTA, Side.CYAN)
    goals = " : ".join(str(state.score.of(side)) for side in sides)
    return f"{goals}, {task}" if task else goals


def _phase_text(state: GameState) -> str:
    minutes, seconds = divmod(int(state.clock), 60)
    of = f" {state.side.value}" if state.side is not None else ""
    return f"{minutes}:{seconds:02d}  {state.phase.value.replace('_', ' ')}{of}"
