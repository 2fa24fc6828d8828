"""The fields in which two commands, or two messages of other kinds, differ, with their units."""

from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple, get_args, get_origin

import msgspec

from schemas.messages.command import Command
from schemas.wire.faults import hints_of

_DECIMALS = range(3, 17)
_LONGEST = 60


class FieldDifference(NamedTuple):
    """A field that differs, by its name with dots, `drive.vx`."""

    field: str
    recorded: Any
    answered: Any

    def texts(self) -> tuple[str, str]:
        """Both values with their unit, and as many decimals as it takes to see that they differ."""
        unit = _unit_of(self.field)
        values = self.recorded, self.answered
        for decimals in _DECIMALS:
            one, other = (_text(value, unit, decimals) for value in values)
            if one != other:
                return one, other
        return repr(self.recorded), repr(self.answered)


def differences(recorded: Command, answered: Command) -> list[FieldDifference]:
    """The fields in which a command differs from the recorded one; a part that only one of them has is one field.

    What a brain under examination draws is left out: no other robot and no host acts on it.
    """
    return list(field_differences(recorded.plain("debug"), answered.plain("debug")))


def field_differences(recorded: Any, answered: Any, path: str = "") -> Iterator[FieldDifference]:
    """Where two nested tables differ; None stands for what one of them lacks."""
    if isinstance(recorded, dict) and isinstance(answered, dict):
        for name in {**recorded, **answered}:
            yield from field_differences(recorded.get(name), answered.get(name), f"{path}.{name}".lstrip("."))
    elif recorded != answered:
        yield FieldDifference(path, recorded, answered)


def _text(value: Any, unit: str, decimals: int) -> str:
    if isinstance(value, dict):
        parts = ", ".join(f"{name} {_text(part, '', decimals)}" for name, part in value.items())
        return parts if len(parts) <= _LONGEST else f"{parts[: _LONGEST - 1]}…"
    if isinstance(value, float):
        return f"{value:.{decimals}f} {unit}".rstrip()
    return str(value)


@cache
def _unit_of(field: str) -> str:
    """The unit of a number in a command; empty for none."""
    kind: Any = Command
    for step in field.split("."):
        kind = next((one for one in _kinds(kind) if step in hints_of(one)), None)
        if kind is None:
            return ""
        kind = hints_of(kind)[step]
    return next((meta.extra["unit"] for meta in _metas(kind) if meta.extra and "unit" in meta.extra), "")


def _kinds(hint: Any) -> list[type]:
    """The structs that a type consists of."""
    if isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        return [hint]
    return [kind for part in get_args(hint) for kind in _kinds(part)] if get_origin(hint) is not None else []


def _metas(hint: Any) -> list[msgspec.Meta]:
    if isinstance(hint, msgspec.Meta):
        return [hint]
    return [meta for part in get_args(hint) for meta in _metas(part)]
