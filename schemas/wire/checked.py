"""Parts that brains construct: a constructor call is checked like a decoded part."""

import re
from typing import Any, TypeVar

import msgspec

from schemas.wire.faults import FaultError
from schemas.wire.part import PartType, convert
from schemas.wire.part_faults import fault_of_content

T = TypeVar("T")


class Checked(PartType):
    """The metaclass of parts that brains construct: a constructor call is checked like a decoded part.

    Converts scalars of numpy to Python's numbers, and values of enumerations to their members.

    Decoding and `Part.replace` do not call it, so that nothing is checked twice.
    """

    def __call__(cls: type[T], **fields: Any) -> T:  # noqa: N805
        """Construct a part.

        Raises:
            FaultError: a field has another type, is beyond its limits, or is not a finite number.
        """
        try:
            part: T = convert(msgspec.to_builtins(fields, enc_hook=_number), cls)
        except (TypeError, ValueError):
            owner = re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()
            raise FaultError(fault_of_content(cls, fields), owner) from None
        return part


def _number(value: Any) -> Any:
    """A scalar of numpy as a number of Python."""
    if getattr(value, "shape", None) != ():
        raise TypeError(value)
    return value.item()
