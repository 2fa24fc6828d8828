"""What a base station of ours does for each signal of the league's referee box, as one table. Pure.

Two base stations of ours may be connected to one box. Then each forwards the signals for its own side, and cyan's also
those for both.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from schemas.messages.coach import CoachMode
from schemas.messages.soccer.game import GameState, RefereeAction
from schemas.messages.soccer.league.signals import SIGNALS, Signal
from schemas.side import Side
from schemas.soccer.game import REFBOX, RESTARTS, ActionName, EventKind, GameStage, Phase

BREAKS = (Phase.HALF_TIME, Phase.PARKING)
"""Phases after which START begins the next half."""
WAITS_FOR_START = RESTARTS | {Phase.PRE_GAME, Phase.STOPPED, *BREAKS}
"""Phases that START leads on from, one step at a time."""


@dataclass(frozen=True, slots=True)
class SignalResponse:
    """The actions and orders that follow from one signal."""

    actions: tuple[RefereeAction, ...] = ()
    """Actions for the referee, one after the other."""
    until_running: bool = False
    """The last action is repeated until the game runs: the box's START lets play begin at once, ours advances the game
    by one step."""
    order: CoachMode | None = None
    """Order for the sides that this base station speaks for."""
    reason: str = ""
    """Why nothing is done, where our game has no counterpart."""


_NOTHING = SignalResponse()
_Rule = Callable[[Signal, "Side | None", "str | None", GameState], SignalResponse]


def _action(name: ActionName, side: Side | None = None, robot: str | None = None) -> RefereeAction:
    return RefereeAction(action=name, side=side, robot=robot, source=REFBOX)


def _plain(name: ActionName) -> _Rule:
    return lambda _signal, side, _robot, _state: SignalResponse((_action(name, side),))


def _for_robot(name: ActionName) -> _Rule:
    """The action on the robot; without a robot on the side, which is asked to name it."""

    def rule(_signal: Signal, side: Side | None, robot: str | None, _state: GameState) -> SignalResponse:
        return SignalResponse((_action(name, robot=robot) if robot is not None else _action(name, side),))

    return rule


def _start(_signal: Signal, _side: Side | None, _robot: str | None, state: GameState) -> SignalResponse:
    waits = state.phase in WAITS_FOR_START and not state.running
    return SignalResponse((_action(ActionName.START),), until_running=waits)


def _restart(signal: Signal, side: Side | None, _robot: str | None, state: GameState) -> SignalResponse:
    """The restart itself. After a break the half has to begin first, which signals the kick-off of the right side."""
    if signal.phase is None or (state.phase, state.side, state.running) == (signal.phase, side, False):
        return _NOTHING
    wanted = _action(ActionName(signal.phase.value), side)
    return SignalResponse((_action(ActionName.START), wanted) if state.phase in BREAKS else (wanted,))


def _next_half(_signal: Signal, _side: Side | None, _robot: str | None, state: GameState) -> SignalResponse:
    return SignalResponse((_action(ActionName.START),)) if state.phase in BREAKS else _NOTHING


def _end_part(_signal: Signal, _side: Side | None, _robot: str | None, state: GameState) -> SignalResponse:
    """The end of the half, or of the match where the shoot-out is its last part."""
    is_last = state.stage is GameStage.SHOOT_OUT
    return SignalResponse((_action(ActionName.END_GAME if is_last else ActionName.END_HALF),))


def _end(_signal: Signal, _side: Side | None, _robot: str | None, state: GameState) -> SignalResponse:
    """The end of the half or the game: the box ends the second half with it, too, and overtime may follow."""
    goes_on = state.half > 1 and state.stage is not GameStage.SHOOT_OUT
    return SignalResponse((_action(ActionName.END_HALF if goes_on else ActionName.END_GAME),))


def _known(_signal: Signal, _side: Side | None, _robot: str | None, _state: GameState) -> SignalResponse:
    """Our game needs no action for it."""
    return _NOTHING


def _unsupported(why: str) -> _Rule:
    return lambda signal, _side, _robot, _state: SignalResponse(reason=f"{signal.name} {why}")


_TEAM_MATTER = _unsupported("has no action of our referee; coaches give orders in test mode")
_OLD = _unsupported("belongs to a protocol older than the league's rules here")

FORWARD: Mapping[str, _Rule] = {
    **{signal.name: _restart for signal in SIGNALS if signal.kind is EventKind.RESTART},
    "START": _start,
    "STOP": _plain(ActionName.STOP),
    "HALT": _plain(ActionName.STOP),
    "GOAL": _plain(ActionName.GOAL),
    "SUBGOAL": _plain(ActionName.CANCEL_GOAL),
    "YELLOW_CARD": _for_robot(ActionName.YELLOW_CARD),
    "DOUBLE_YELLOW": _for_robot(ActionName.DOUBLE_YELLOW),
    "RED_CARD": _for_robot(ActionName.RED_CARD),
    "REPAIR": _for_robot(ActionName.REPAIR),
    "REPAIR_END": _for_robot(ActionName.ENTER),
    "SUBSTITUTION": _for_robot(ActionName.SUBSTITUTE),
    "HALF_TIME": _end_part,
    "END_PART": _end_part,
    "END_GAME": _end,
    "GAMEOVER": _plain(ActionName.END_GAME),
    "FIRST_HALF": _known,
    "SECOND_HALF": _next_half,
    "FIRST_HALF_OVERTIME": _next_half,
    "SECOND_HALF_OVERTIME": _next_half,
    "PARK": lambda _signal, _side, _robot, _state: SignalResponse(order=CoachMode.PARK),
    "WELCOME": _known,
    "IS_ALIVE": _known,
    "RESET": _unsupported("would begin the simulation anew; touchline scene reset does"),
    "TESTMODE_ON": _TEAM_MATTER,
    "TESTMODE_OFF": _TEAM_MATTER,
    "READY": _OLD,
    "CANCEL": _OLD,
    "RESTART": _OLD,
}
"""Name of each signal → what it leads to."""


def response_to(signal: Signal, side: Side | None, robot: str | None, state: GameState) -> SignalResponse:
    """What follows from a signal for `side`; `robot` is the name of the robot, if the signal names one."""
    if signal.sided and side is None:
        return SignalResponse(reason=f"{signal.name} does not name its team")
    return FORWARD[signal.name](signal, side, robot, state)


def speaks_for(own: Side, connected: Collection[Side]) -> tuple[Side, ...]:
    """The sides that a base station speaks for: its own, and the other while that has no base station."""
    return (own,) if own.opponent in connected else (own, own.opponent)


def is_ours(signal: Signal, side: Side | None, own: Side, connected: Collection[Side]) -> bool:
    """Whether the base station of `own` forwards a signal; `connected` are the sides whose base stations have a box."""
    if signal.sided and side is not None:
        return side in speaks_for(own, connected)
    return own is Side.CYAN or own.opponent not in connected
