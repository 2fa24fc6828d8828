"""The match in plain words: one line for a state, one for an event."""

from schemas.game import SIDED, GameEvent, GameState


def clock_words(seconds: float) -> str:
    """Game time as `m:ss.s`."""
    tenths = round(seconds * 10)
    return f"{tenths // 600}:{tenths % 600 / 10:04.1f}"


def score_words(state: GameState) -> str:
    """`cyan 1 : 0 magenta`."""
    return f"cyan {state.score.cyan} : {state.score.magenta} magenta"


def phase_words(state: GameState) -> str:
    """What is being played and by whom: `throw in, magenta` before START, `throw in, magenta, started` after it."""
    words = [state.phase.value.replace("_", " ")]
    if state.phase in SIDED:
        if state.side is not None:
            words.append(state.side.value)
        if state.running:
            words.append("started")
    return ", ".join(words)


def state_line(state: GameState) -> str:
    """Clock, score and phase."""
    return f"{clock_words(state.clock):>7}  {score_words(state)}  {phase_words(state)}"


def event_line(event: GameEvent) -> str:
    """Clock, kind and sentence of an event."""
    return f"{clock_words(event.clock):>7}  {event.kind.value.replace('_', ' ')}: {event.text}"
