"""Numbers as a picture needs them: rounded to mm, mm/s, mrad and ms, a fraction of the digits of the bus. Pure."""

from typing import Any

import msgspec

_DIGITS = 3


def rounded_json(payload: bytes) -> str:
    """A JSON text with all its numbers rounded to three decimals."""
    return msgspec.json.encode(_rounded(msgspec.json.decode(payload))).decode()


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, _DIGITS) + 0.0  # zero has no sign
    if isinstance(value, dict):
        return {name: _rounded(item) for name, item in value.items()}
    return [_rounded(item) for item in value] if isinstance(value, list) else value
