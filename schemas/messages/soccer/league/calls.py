"""The signals that the league's referee box would give between two states of our game."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.messages.soccer.league.signals import (
    BY_NAME,
    END_GAME,
    HALF_OF,
    HALF_TIME,
    RESTART_OF,
    START,
    STOP,
    Signal,
)
from schemas.natural_order import natural_order
from schemas.side import Side
from schemas.soccer.game import GameStage, OffField, Phase, Score

_PHASES: Mapping[Phase, Signal] = {
    Phase.PARKING: BY_NAME["PARK"],
    Phase.FULL_TIME: BY_NAME["GAMEOVER"],
} | {phase: signal for phase, signal in RESTART_OF.items() if phase is not None}
"""Phase → the signal when it begins; STOP comes before goals, these signals after them."""
_AFTER_HALF = (Phase.PARKING, Phase.HALF_TIME, Phase.FULL_TIME)
"""Phases after the end of a half."""
_LEAVES: Mapping[OffField, Signal] = {
    OffField.REPAIR: BY_NAME["REPAIR"],
    OffField.SUBSTITUTION: BY_NAME["SUBSTITUTION"],
    OffField.SILENT: BY_NAME["IS_ALIVE"],
}
"""Why a robot left → the signal; after a robot without a program, the box queries whether it is alive."""
_CLEAN = DisciplinaryRecord()


class Call(NamedTuple):
    """One signal with the side that it concerns, where it concerns one, and the robot by name."""

    signal: Signal
    side: Side | None = None
    robot: str | None = None


def calls(old: GameState | None, new: GameState, sides: Mapping[str, Side]) -> list[Call]:
    """The signals from one state to the next, in order; None stands for the state before the match.

    `sides` maps robots to sides. The league has no signal for a revoked card.
    """
    before = old if old is not None else GameState(tick=0, time=0.0, phase=Phase.PRE_GAME)
    found = list(_half(old, new))
    changed = (new.phase, new.side) != (before.phase, before.side)
    ends_half = new.phase in _AFTER_HALF and before.phase not in _AFTER_HALF
    if (changed and new.phase is Phase.STOPPED) or (ends_half and before.running):
        found.append(Call(STOP))
    for side in Side:
        goals = _goals(new, side) - _goals(before, side)
        found += [Call(BY_NAME["GOAL" if goals > 0 else "SUBGOAL"], side)] * abs(goals)
    found += _people(before, new, sides)
    if ends_half:
        found.append(Call(_end_of_half(new)))
    if changed and new.phase in _PHASES:
        signal = _PHASES[new.phase]
        found.append(Call(signal, new.side if signal.sided else None))
    if new.running and not before.running:
        found.append(Call(START))
    return found


def _goals(state: GameState, side: Side) -> int:
    """Goals of a side; for those of the shoot-out the box has the same signal."""
    return state.score.of(side) + (state.shoot_out or Score()).of(side)


def _end_of_half(new: GameState) -> Signal:
    """The end of the first half of regular or extra time is half time, every other one the end of the game.

    The box ends the second half so even if extra time follows. The robots park after it.
    """
    first = new.half % 2 == 1 and new.stage is not GameStage.SHOOT_OUT and new.phase is not Phase.FULL_TIME
    return HALF_TIME if first else END_GAME


def _half(old: GameState | None, new: GameState) -> Iterator[Call]:
    """A half begins with its kick-off; for the box, the shoot-out is not a half."""
    if new.phase is Phase.PRE_GAME or new.stage is GameStage.SHOOT_OUT:
        return
    if (old is None or old.phase is Phase.PRE_GAME or new.half != old.half) and new.half in HALF_OF:
        yield Call(HALF_OF[new.half])


def _people(before: GameState, new: GameState, sides: Mapping[str, Side]) -> Iterator[Call]:
    for name in sorted({*before.robots, *new.robots}, key=natural_order):
        if name in sides:
            was, now = before.robots.get(name, _CLEAN), new.robots.get(name, _CLEAN)
            for signal in _person(was, now):
                yield Call(signal, sides[name], name)


def _person(was: DisciplinaryRecord, now: DisciplinaryRecord) -> Iterator[Signal]:
    left = now.off_field is not was.off_field
    if now.red > was.red:
        yield BY_NAME["RED_CARD"]
    elif left and now.off_field is OffField.SECOND_YELLOW:
        yield BY_NAME["DOUBLE_YELLOW"]
    elif now.yellow > was.yellow:
        yield BY_NAME["YELLOW_CARD"]
    if left and now.off_field is not None and now.off_field in _LEAVES:
        yield _LEAVES[now.off_field]
    elif left and was.off_field is OffField.REPAIR:
        yield BY_NAME["REPAIR_END"]


def minutes(seconds: float) -> str:
    """A time of the game as the box writes it, `07:30`."""
    whole = max(0, int(seconds))
    return f"{whole // 60:02d}:{whole % 60:02d}"
