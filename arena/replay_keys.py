"""Playing a recording by keys: a pure core, (key, how the replay stands) → what is asked of it."""

from collections.abc import Callable, Mapping, Sequence

from arena.terminal import DOWN, LEFT, RIGHT, UP, typed
from recordings.replay.moments import Moment
from schemas.replay import ReplayDeed, ReplayReply, ReplayRequest

_JUMP_S = 5.0
"""Simulated s that an arrow goes on or back."""
_FASTEST = 64.0
"""Faster than this is as fast as possible."""
_SLOWEST = 1 / 64
_NEAR_S = 1.0
"""Simulated s behind an event within which `b` goes to the one before it: else one would never get past it."""

Ask = Callable[[ReplayReply, Sequence[Moment]], ReplayRequest]


def _by(seconds: float) -> Ask:
    return lambda *_: ReplayRequest(deed=ReplayDeed.SEEK, by=seconds)


def _to(seconds: float) -> ReplayRequest:
    return ReplayRequest(deed=ReplayDeed.SEEK, to=f"{seconds:.9f}")


def _pause(status: ReplayReply, moments: Sequence[Moment]) -> ReplayRequest:
    del moments
    return ReplayRequest(deed=ReplayDeed.PLAY if status.paused else ReplayDeed.PAUSE)


def _faster(status: ReplayReply, moments: Sequence[Moment]) -> ReplayRequest:
    del moments
    rate = 2 * status.rate if status.rate is not None else None
    return ReplayRequest(deed=ReplayDeed.RATE, rate=rate if rate is not None and rate <= _FASTEST else None)


def _slower(status: ReplayReply, moments: Sequence[Moment]) -> ReplayRequest:
    del moments
    rate = status.rate / 2 if status.rate is not None else _FASTEST
    return ReplayRequest(deed=ReplayDeed.RATE, rate=max(rate, _SLOWEST))


def _next(status: ReplayReply, moments: Sequence[Moment]) -> ReplayRequest:
    return _to(next((moment.time for moment in moments if moment.time > status.time), status.end))


def _before(status: ReplayReply, moments: Sequence[Moment]) -> ReplayRequest:
    earlier = [moment.time for moment in moments if moment.time < status.time - _NEAR_S]
    return _to(earlier[-1] if earlier else status.start)


KEYS: Mapping[str, tuple[str, str, Ask]] = {
    " ": ("space", "pause or go on", _pause),
    ".": (".", "one tick", lambda *_: ReplayRequest(deed=ReplayDeed.STEP)),
    RIGHT: ("→", f"{_JUMP_S:g} s on", _by(_JUMP_S)),
    LEFT: ("←", f"{_JUMP_S:g} s back", _by(-_JUMP_S)),
    UP: ("↑", "twice as fast", _faster),
    DOWN: ("↓", "half as fast", _slower),
    "n": ("n", "next event", _next),
    "b": ("b", "event before", _before),
    "0": ("0", "to the beginning", lambda status, _: _to(status.start)),
    "e": ("e", "to the end", lambda status, _: _to(status.end)),
    "l": ("l", "loop or not", lambda *_: ReplayRequest(deed=ReplayDeed.LOOP)),
    "q": ("q", "leave", lambda *_: ReplayRequest(deed=ReplayDeed.LEAVE)),
}
"""Key → its name, what it does, and what it asks for."""


def asks(text: str) -> list[Ask]:
    """What the keys ask for that a terminal sent; others mean nothing."""
    return [KEYS[key][2] for key in typed(text) if key in KEYS]


def legend() -> str:
    """All keys in one line."""
    return ", ".join(f"{name} {words}" for name, words, _ in KEYS.values())
