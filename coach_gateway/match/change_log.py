"""The match as plain lines, one for each change, until its host leaves."""

import threading
from collections.abc import Callable

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from coach_gateway.match.lines import event_line, state_line
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from coach_gateway.timing import POLL_S, REPLY_S
from schemas.bus.contract import Bus, PresenceKind
from schemas.errors import TouchlineError
from schemas.messages.game import GameEvent, GameState
from schemas.messages.health import Health


def log_changes(bus: Bus, log: Callable[[str], None], stop: threading.Event, patience: float = REPLY_S) -> None:
    """Log a line for each change until the host leaves or `stop` is set.

    Raises:
        TouchlineError: no host appears within `patience` s of wall time.
    """
    follower = MatchFollower(bus)
    bus.declare_alive(PresenceKind.COACH, "watch")
    if not follower.host.wait(patience):
        raise TouchlineError(f'match "{bus.match}": no host plays it there; name the match with --match')
    names = HostClient(bus, patience).team_names()
    before: GameState | None = None
    going = True
    while going:
        going = not stop.is_set()
        for message in follower.update().messages:
            line = change_line(before, message, names)
            before = message if isinstance(message, GameState) else before
            if line is not None:
                log(line)
        going = going and not follower.gone
        if going:
            bus.clock.sleep_until(bus.clock.now() + POLL_S)


def change_line(
    before: GameState | None, message: GameEvent | GameState | Health, names: TeamNames = SIDES_ALONE
) -> str | None:
    """The line for a message; None when people see nothing new in it."""
    match message:
        case GameEvent():
            return event_line(message, names)
        case GameState():
            is_news = before is None or _comparison_key(before) != _comparison_key(message)
            return state_line(message, names) if is_news else None
        case Health():
            return None


def _comparison_key(state: GameState) -> tuple[object, ...]:
    """The fields whose change is worth a line."""
    asked = [(question.side, question.action) for question in state.questions]
    return state.phase, state.side, state.running, state.half, state.score, asked
