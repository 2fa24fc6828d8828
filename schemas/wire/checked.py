"""Parts that brains construct: a constructor call is checked like a decoded part."""

import re
from functools import cache
from typing import Any, TypeVar, get_args

import msgspec

from schemas.wire.faults import FaultError
from schemas.wire.part import PartType, convert
from schemas.wire.part_faults import fault_of_content

T = TypeVar("T")


class Checked(PartType):
    """The metaclass of parts that brains construct: a constructor call is checked like a decoded part.

    Converts scalars of numpy to Python's numbers, and values of enumerations to their members.

    Nothing is checked twice: decoding and `Part.replace` do not call it, and a part that was checked when it was made
    is taken as it is.
    """

    def __call__(cls: type[T], **fields: Any) -> T:  # noqa: N805
        """Construct a part.

        Raises:
            FaultError: a field has another type, is beyond its limits, or is not a finite number.
        """
        part: T
        if not _has_unchecked_parts(cls):  # type: ignore[arg-type]
            try:
                part = msgspec.convert(fields, cls)
            except ValueError:
                pass  # there is a fault, or a number of numpy
            else:
                return part
        try:
            part = convert(msgspec.to_builtins(fields, enc_hook=_number), cls)
        except (TypeError, ValueError):
            owner = re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()
            raise FaultError(fault_of_content(cls, fields), owner) from None
        return part


@cache
def _has_unchecked_parts(kind: type) -> bool:
    """Whether a part has other parts, also in lists, that are not checked when they are made."""

    def is_unchecked(hint: Any) -> bool:
        if isinstance(hint, PartType):
            return not isinstance(hint, Checked)
        return any(is_unchecked(one) for one in get_args(hint))

    return any(is_unchecked(field.type) for field in msgspec.structs.fields(kind))


def _number(value: Any) -> Any:
    """A scalar of numpy as a number of Python."""
    if getattr(value, "shape", None) != ():
        raise TypeError(value)
    return value.item()
