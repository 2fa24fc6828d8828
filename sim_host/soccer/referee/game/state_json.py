"""The state of the referee as JSON and back: a recording holds it at checkpoints, where a simulation may begin."""

from typing import Any

import msgspec

from schemas.wire.part import encode
from sim_host.soccer.referee.game.referee_state import RefereeState


def state_json(state: RefereeState) -> str:
    """The complete state; floats keep every bit."""
    return encode(state).decode()


def state_from_json(text: str) -> RefereeState:
    """The state in a text of `state_json`.

    Raises:
        ValueError: the text is not a state of this version's referee.
    """
    return _decode(text)


def _decode_part(kind: type, fields: Any) -> Any:
    return kind(**fields)


_decode = msgspec.json.Decoder(RefereeState, dec_hook=_decode_part).decode
