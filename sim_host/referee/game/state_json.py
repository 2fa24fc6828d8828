"""The state of the referee as JSON and back: a recording holds it at checkpoints, where a simulation may begin.

A tuple of the state is an array in JSON. A new field therefore stands last in its tuple and has a default: the states
of older recordings, whose arrays are shorter, then still can be read.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import msgspec

from schemas.wire.struct import encode
from sim_host.referee.game.referee_state import RefereeState


def state_json(state: RefereeState) -> str:
    """The complete state; floats keep every bit."""
    return encode(state).decode()


def state_from_json(text: str) -> RefereeState:
    """The state in a text of `state_json`.

    Raises:
        ValueError: the text is not a state of this version's referee.
    """
    return _decode(text)


def without_newer_fields(state: RefereeState, recorded: RefereeState, text: str) -> RefereeState:
    """The state with the values of `recorded` in all fields that the JSON text of `recorded` lacks, to compare both."""
    restricted: RefereeState = _restricted(state, recorded, msgspec.json.decode(text))
    return restricted


def _restricted(value: Any, recorded: Any, plain: Any) -> Any:
    """The value with what is recorded wherever `plain`, the JSON of `recorded`, has no value."""
    if type(value) is not type(recorded):
        return value
    if isinstance(value, tuple) and isinstance(plain, list):
        if hasattr(value, "_fields"):
            return type(value)(*_restricted_items(value, recorded, plain), *recorded[len(plain) :])
        return tuple(_restricted_items(value, recorded, plain)) if len(value) == len(recorded) else value
    if is_dataclass(value) and not isinstance(value, type) and isinstance(plain, dict):
        names = [field.name for field in fields(value)]
        changed = {
            name: _restricted(getattr(value, name), getattr(recorded, name), plain[name])
            if name in plain
            else getattr(recorded, name)
            for name in names
        }
        return replace(value, **changed)
    if isinstance(value, Mapping) and isinstance(plain, dict):
        known = {key: recorded[key] for key in value if key in recorded and str(key) in plain}
        return {**value, **{key: _restricted(value[key], theirs, plain[str(key)]) for key, theirs in known.items()}}
    return value


def _restricted_items(values: Any, recorded: Any, plain: list[Any]) -> list[Any]:
    return [_restricted(*each) for each in zip(values, recorded, plain, strict=False)]


def _decode_part(kind: type, fields: Any) -> Any:
    return kind(**fields)


_decode = msgspec.json.Decoder(RefereeState, dec_hook=_decode_part).decode
