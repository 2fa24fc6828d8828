"""The match in plain words: one line for a state, one for an event."""

from schemas.game import SIDED, GameStage
from schemas.messages.game import GameEvent, GameState


def printable(text: str) -> str:
    """A text from the network as one line without control characters, which a terminal would obey."""
    return "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in text)


def clock_text(seconds: float) -> str:
    """Game time as `m:ss.s`."""
    tenths = round(seconds * 10)
    return f"{tenths // 600}:{tenths % 600 / 10:04.1f}"


def score_text(state: GameState) -> str:
    """`cyan 1 : 0 magenta`."""
    return f"cyan {state.score.cyan} : {state.score.magenta} magenta"


def phase_text(state: GameState) -> str:
    """The phase and its side: `throw in, magenta` before START, `throw in, magenta, started` after it."""
    words = [state.phase.value.replace("_", " ")]
    if state.phase in SIDED:
        if state.side is not None:
            words.append(state.side.value)
        if state.running:
            words.append("started")
    return ", ".join(words)


def half_text(state: GameState) -> str:
    """`half 1`, `extra time, half 3`, or `penalties 4 : 3` with cyan's goals first."""
    if state.stage is GameStage.SHOOT_OUT and state.shoot_out is not None:
        return f"penalties {state.shoot_out.cyan} : {state.shoot_out.magenta}"
    return f"extra time, half {state.half}" if state.stage is GameStage.EXTRA_TIME else f"half {state.half}"


def discipline_phrases(state: GameState) -> list[str]:
    """One phrase for each robot with a card or off the field: `cyan3 2 yellow, off: repair 12 s`."""
    phrases = []
    for name, entry in state.robots.items():
        words = [f"{number} {card}" for card, number in (("yellow", entry.yellow), ("red", entry.red)) if number]
        if entry.off_field is not None:
            left = "" if entry.left is None else f" {entry.left:.0f} s"
            words.append(f"off: {entry.off_field.value.replace('_', ' ')}{left}")
        if words:
            phrases.append(f"{name} {', '.join(words)}")
    return phrases


def question_phrases(state: GameState) -> list[str]:
    """One phrase for each action that waits for its robot: `cyan names the robot for: yellow card, else cyan4`."""
    return [
        f"{question.side} names the robot for: {question.action.value.replace('_', ' ')}, else {question.default}"
        for question in state.questions
    ]


def state_line(state: GameState) -> str:
    """Clock, half, score and phase, robots with cards or off the field, and what is proposed."""
    parts = [f"{clock_text(state.clock):>7}", half_text(state), score_text(state), phase_text(state)]
    discipline = discipline_phrases(state)
    if discipline:
        parts.append(f"[{'; '.join(discipline)}]")
    if state.proposal is not None:
        parts.append(f"proposed: {state.proposal}")
    parts += question_phrases(state)
    return "  ".join(parts)


def event_line(event: GameEvent) -> str:
    """Clock, kind and sentence of an event."""
    return f"{clock_text(event.clock):>7}  {event.kind.value.replace('_', ' ')}: {event.text}"
