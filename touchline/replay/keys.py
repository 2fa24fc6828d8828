"""Control keys of a replay: a pure function, (key, replay status) → request."""

from collections.abc import Callable, Mapping, Sequence

from recordings.replay.seek_targets import SeekTarget
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from touchline.cli.terminal import DOWN, LEFT, RIGHT, UP, parse_keys

_JUMP_S = 5.0
"""Seek step of an arrow key, simulated s."""
_FASTEST = 64.0
"""Highest rate; the next step up is as fast as possible."""
_SLOWEST = 1 / 64
_NEAR_S = 1.0
"""Simulated s after an event within which `b` seeks to the previous event; otherwise `b` would stay at this one."""

KeyRequest = Callable[[ReplayReply, Sequence[SeekTarget]], ReplayRequest]


def _by(seconds: float) -> KeyRequest:
    return lambda *_: ReplayRequest(operation=ReplayOperation.SEEK, by=seconds)


def _to(seconds: float) -> ReplayRequest:
    return ReplayRequest(operation=ReplayOperation.SEEK, to=f"{seconds:.9f}")


def _pause(status: ReplayReply, moments: Sequence[SeekTarget]) -> ReplayRequest:
    del moments
    return ReplayRequest(operation=ReplayOperation.PLAY if status.paused else ReplayOperation.PAUSE)


def _faster(status: ReplayReply, moments: Sequence[SeekTarget]) -> ReplayRequest:
    del moments
    rate = 2 * status.rate if status.rate is not None else None
    return ReplayRequest(operation=ReplayOperation.RATE, rate=rate if rate is not None and rate <= _FASTEST else None)


def _slower(status: ReplayReply, moments: Sequence[SeekTarget]) -> ReplayRequest:
    del moments
    rate = status.rate / 2 if status.rate is not None else _FASTEST
    return ReplayRequest(operation=ReplayOperation.RATE, rate=max(rate, _SLOWEST))


def _next(status: ReplayReply, moments: Sequence[SeekTarget]) -> ReplayRequest:
    return _to(next((moment.time for moment in moments if moment.time > status.time), status.end))


def _before(status: ReplayReply, moments: Sequence[SeekTarget]) -> ReplayRequest:
    earlier = [moment.time for moment in moments if moment.time < status.time - _NEAR_S]
    return _to(earlier[-1] if earlier else status.start)


KEYS: Mapping[str, tuple[str, str, KeyRequest]] = {
    " ": ("space", "pause or resume", _pause),
    ".": (".", "one tick", lambda *_: ReplayRequest(operation=ReplayOperation.STEP)),
    RIGHT: ("→", f"{_JUMP_S:g} s forward", _by(_JUMP_S)),
    LEFT: ("←", f"{_JUMP_S:g} s back", _by(-_JUMP_S)),
    UP: ("↑", "twice as fast", _faster),
    DOWN: ("↓", "half as fast", _slower),
    "n": ("n", "next event", _next),
    "b": ("b", "event before", _before),
    "0": ("0", "to the beginning", lambda status, _: _to(status.start)),
    "e": ("e", "to the end", lambda status, _: _to(status.end)),
    "l": ("l", "loop on or off", lambda *_: ReplayRequest(operation=ReplayOperation.LOOP)),
    "q": ("q", "leave", lambda *_: ReplayRequest(operation=ReplayOperation.LEAVE)),
}
"""Key → its name, its description, and its request."""


def key_requests(text: str) -> list[KeyRequest]:
    """The requests for the keys in a terminal's input; unknown keys are ignored."""
    return [KEYS[key][2] for key in parse_keys(text) if key in KEYS]


def legend() -> str:
    """The legend of all keys, in one line."""
    return ", ".join(f"{name} {words}" for name, words, _ in KEYS.values())
