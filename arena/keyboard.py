"""Driving a robot by keys: a pure core, (hand, key, time) → hand, and what the hand says at a time.

The keys are those of the paper's teleoperation node, and so are the speeds that the command line begins with.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from arena.terminal import DOWN, LEFT, RIGHT, UP, typed
from schemas.command import Drive, Kick, KickMode
from schemas.hand import HandDrive

HOLDS_S = 0.5
"""s that a key of motion counts for: a terminal tells of no release, and repeats a held key sooner than that."""


@dataclass(frozen=True, slots=True)
class Speeds:
    """How fast keys move a robot: m/s, rad/s, and m/s of the ball."""

    drive: float = 1.0
    turn: float = 1.0
    kick: float = 10.0


@dataclass(frozen=True, slots=True)
class Axis:
    """One direction of motion: −1, 0 or 1, and the time in s at which its key was pressed."""

    sign: int = 0
    since: float = 0.0

    def at(self, now: float) -> int:
        """The direction that still counts."""
        return self.sign if now - self.since < HOLDS_S else 0


@dataclass(frozen=True, slots=True)
class Hand:
    """Everything that keys have said."""

    ahead: Axis = Axis()
    """1 is forward."""
    aside: Axis = Axis()
    """1 is to the left."""
    turn: Axis = Axis()
    """1 is counter-clockwise."""
    dribble: bool = False
    mode: KickMode = KickMode.GROUND
    kicks: bool = False
    """A kick is to be said next."""


Press = Callable[[Hand, float], Hand]

_MODES = tuple(KickMode)

KEYS: Mapping[str, tuple[str, Press]] = {
    UP: ("forward", lambda hand, now: replace(hand, ahead=Axis(1, now))),
    DOWN: ("backward", lambda hand, now: replace(hand, ahead=Axis(-1, now))),
    LEFT: ("to the left", lambda hand, now: replace(hand, aside=Axis(1, now))),
    RIGHT: ("to the right", lambda hand, now: replace(hand, aside=Axis(-1, now))),
    ",": ("turn left", lambda hand, now: replace(hand, turn=Axis(1, now))),
    ".": ("turn right", lambda hand, now: replace(hand, turn=Axis(-1, now))),
    "z": ("dribbler on or off", lambda hand, _: replace(hand, dribble=not hand.dribble)),
    "x": ("next kick mode", lambda hand, _: replace(hand, mode=_MODES[(_MODES.index(hand.mode) + 1) % len(_MODES)])),
    " ": ("kick", lambda hand, _: replace(hand, kicks=True)),
}
"""Key → what it does, in words and in deed."""


def keys_in(text: str) -> list[str]:
    """The keys that a terminal sent, arrows by name; what is no key of ours is left out."""
    return [key for key in typed(text) if key in KEYS]


def pressed(hand: Hand, text: str, now: float) -> Hand:
    """The hand after what a terminal sent at a time in s."""
    for key in keys_in(text):
        hand = KEYS[key][1](hand, now)
    return hand


def said(hand: Hand, speeds: Speeds, now: float) -> HandDrive:
    """What the hand says at a time in s."""
    return HandDrive(
        drive=Drive(
            vx=speeds.drive * hand.ahead.at(now),
            vy=speeds.drive * hand.aside.at(now),
            omega=speeds.turn * hand.turn.at(now),
        ),
        dribble=hand.dribble,
        kick=Kick(mode=hand.mode, speed=speeds.kick) if hand.kicks else None,
    )


def status(hand: Hand) -> str:
    """One line on what the keys have switched."""
    return f"dribbler {'on' if hand.dribble else 'off'}, kick {hand.mode.value}"
