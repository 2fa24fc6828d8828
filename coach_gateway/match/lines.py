"""The match in plain words: one line for a state, one for an event."""

from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import SIDED, GameStage


def clock_text(seconds: float) -> str:
    """Game time as `m:ss.s`."""
    tenths = round(seconds * 10)
    return f"{tenths // 600}:{tenths % 600 / 10:04.1f}"


def phase_text(state: GameState, names: TeamNames = SIDES_ALONE) -> str:
    """The phase and its team: `throw in, magenta` before START, `throw in, magenta, started` after it."""
    words = [state.phase.value.replace("_", " ")]
    if state.phase in SIDED:
        if state.side is not None:
            words.append(names[state.side])
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


def waiting_phrases(state: GameState, names: TeamNames = SIDES_ALONE) -> list[str]:
    """What waits for people: the referee's proposal, without the name of its rule, which its sentence says; and each
    action that waits for its robot, `Lions names the robot for: yellow card, else cyan4`."""
    proposed = [] if state.proposal is None else [f"proposed: {names.in_text(state.proposal.split(': ', 1)[-1])}"]
    return proposed + [
        f"{names[asked.side]} names the robot for: {asked.action.value.replace('_', ' ')}, else {asked.default}"
        for asked in state.questions
    ]


def state_line(state: GameState, names: TeamNames = SIDES_ALONE) -> str:
    """Clock, half, score and phase, robots with cards or off the field, and what is proposed."""
    half = [half_text(state)] if names.has_goals else []
    score = names.score(state.score, state.value)
    parts = [f"{clock_text(state.clock):>7}", *half, score, phase_text(state, names)]
    discipline = discipline_phrases(state)
    if discipline:
        parts.append(f"[{'; '.join(discipline)}]")
    return "  ".join([*parts, *waiting_phrases(state, names)])


def event_line(event: GameEvent, names: TeamNames = SIDES_ALONE) -> str:
    """Clock, kind and sentence of an event; a sentence that begins with the kind does not repeat it."""
    kind = event.kind.value.replace("_", " ")
    return f"{clock_text(event.clock):>7}  {kind}: {names.in_text(event.text.removeprefix(f'{kind}, '))}"
