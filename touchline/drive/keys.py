"""Drives a robot by keys: pure functions, (state, key, time) → state, and (state, time) → command.

The keys and the default speeds are those of the paper's teleoperation node.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from schemas.messages.command import Drive, Kick, KickMode
from schemas.messages.manual import ManualDrive
from touchline.cli.terminal import DOWN, LEFT, RIGHT, UP, parse_keys

KEY_LASTS_S = 0.5
"""Duration of a motion key's effect, s. A terminal reports no key release; it repeats a held key within this time."""


@dataclass(frozen=True, slots=True)
class Speeds:
    """Speeds of a driven robot: m/s, rad/s, and m/s of the kicked ball."""

    drive: float = 1.0
    turn: float = 1.0
    kick: float = 10.0


@dataclass(frozen=True, slots=True)
class Axis:
    """One direction of motion: −1, 0 or 1, and the time in s at which its key was pressed."""

    sign: int = 0
    since: float = 0.0

    def at(self, now: float) -> int:
        """The direction that is still in effect."""
        return self.sign if now - self.since < KEY_LASTS_S else 0


@dataclass(frozen=True, slots=True)
class KeyState:
    """The state from all keys so far."""

    ahead: Axis = Axis()
    """1 is forward."""
    aside: Axis = Axis()
    """1 is to the left."""
    turn: Axis = Axis()
    """1 is counter-clockwise."""
    dribble: bool = False
    mode: KickMode = KickMode.GROUND
    kicks: bool = False
    """The next command kicks."""


KeyAction = Callable[[KeyState, float], KeyState]

_MODES = tuple(KickMode)

KEYS: Mapping[str, tuple[str, KeyAction]] = {
    UP: ("forward", lambda state, now: replace(state, ahead=Axis(1, now))),
    DOWN: ("backward", lambda state, now: replace(state, ahead=Axis(-1, now))),
    LEFT: ("to the left", lambda state, now: replace(state, aside=Axis(1, now))),
    RIGHT: ("to the right", lambda state, now: replace(state, aside=Axis(-1, now))),
    ",": ("turn left", lambda state, now: replace(state, turn=Axis(1, now))),
    ".": ("turn right", lambda state, now: replace(state, turn=Axis(-1, now))),
    "z": ("dribbler on or off", lambda state, _: replace(state, dribble=not state.dribble)),
    "x": ("next kick mode", lambda state, _: replace(state, mode=_MODES[(_MODES.index(state.mode) + 1) % len(_MODES)])),
    " ": ("kick", lambda state, _: replace(state, kicks=True)),
}
"""Key → its description, and its effect on the state."""


def keys_in(text: str) -> list[str]:
    """The keys in a terminal's input, arrows by name; unknown keys are left out."""
    return [key for key in parse_keys(text) if key in KEYS]


def press_keys(state: KeyState, text: str, now: float) -> KeyState:
    """The state after a terminal's input at a time in s."""
    for key in keys_in(text):
        state = KEYS[key][1](state, now)
    return state


def manual_drive(state: KeyState, speeds: Speeds, now: float) -> ManualDrive:
    """The command for the state at a time in s."""
    return ManualDrive(
        drive=Drive(
            vx=speeds.drive * state.ahead.at(now),
            vy=speeds.drive * state.aside.at(now),
            omega=speeds.turn * state.turn.at(now),
        ),
        dribble=state.dribble,
        kick=Kick(mode=state.mode, speed=speeds.kick) if state.kicks else None,
    )


def status(state: KeyState) -> str:
    """The dribbler and kick mode, in one line."""
    return f"dribbler {'on' if state.dribble else 'off'}, kick {state.mode.value}"
