"""Compares the recorded events and states of the game with the simulated referee's."""

from collections.abc import Sequence
from itertools import zip_longest
from typing import Any

from recordings.reading.recording import RecordedMessage
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import EventKind
from schemas.topics import EVENT, STATE
from schemas.wire.message import valid
from sim_host.match.game_resimulation import OfficiatedTick
from touchline.verify.command_difference import field_differences
from touchline.verify.verdict import Detail


def state_differences(states: Sequence[RecordedMessage], tick: OfficiatedTick) -> list[Detail]:
    """Where the recorded state of the game in one tick is not the one that the simulated referee publishes."""
    if not states:
        if tick.state is None or tick.state_may_be_missing:
            return []
        return [Detail(STATE.key, "message", None, _state_text(tick.state))]
    recorded = valid(states[0].message)
    if tick.state is None:
        return [] if tick.state_may_be_missing else [Detail(STATE.key, "message", _state_text(recorded), None)]
    return _differences(STATE.key, recorded, tick.state)


def event_differences(events: Sequence[RecordedMessage], tick: OfficiatedTick) -> list[Detail]:
    """Where the recorded events of one tick are not the simulated referee's; reports on agents are left out."""
    recorded = [message for event in events if not is_agent_event(message := valid(event.message))]
    if len(recorded) == len(tick.events):
        pairs = zip(recorded, tick.events, strict=True)
        return [detail for theirs, ours in pairs for detail in _differences(_event_name(ours), theirs, ours)]
    extra = [event for event in recorded if event not in tick.events]
    missing = [event for event in tick.events if event not in recorded]
    details = [Detail(_event_name(event), "message", None, event.text) for event in missing]
    details += [Detail(_event_name(event), "message", _text(event), None) for event in extra]
    if not details:
        counts = zip_longest(map(_text, recorded), map(_text, tick.events))
        details = [Detail(EVENT.key, "message", theirs, ours) for theirs, ours in counts if theirs != ours][:1]
    return details


def is_agent_event(event: GameEvent | None) -> bool:
    """Whether an event is the host's report on an agent, and not the referee's."""
    return event is not None and event.kind is EventKind.AGENT


def _differences(name: str, recorded: GameState | GameEvent | None, simulated: GameState | GameEvent) -> list[Detail]:
    if recorded == simulated:
        return []
    if recorded is None:
        return [Detail(name, "message", "not a valid message", "a valid one")]
    found = field_differences(recorded.plain(), simulated.plain())
    return [Detail(name, one.field, one.recorded, one.answered, _apart(one.recorded, one.answered)) for one in found]


def _apart(recorded: Any, simulated: Any) -> float | None:
    """The absolute difference of two numbers; None for other values."""
    are_numbers = isinstance(recorded, float) and isinstance(simulated, float)
    return abs(recorded - simulated) if are_numbers else None


def _event_name(event: GameEvent | None) -> str:
    return f"{EVENT.key} {event.kind}" if event is not None else EVENT.key


def _state_text(state: GameState | None) -> str:
    return "not a valid message" if state is None else f"{state.phase} {state.score.cyan} : {state.score.magenta}"


def _text(event: GameEvent | None) -> str:
    return "not a valid message" if event is None else event.text
