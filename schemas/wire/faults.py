"""Faults of invalid content: one plain sentence with the field, its value and what was expected.

The one formatter for all content from outside: payloads, files, options and pages. The faults of parts of messages are
found in `part_faults`, those of models of the configuration in `model_faults`.
"""

import types
from enum import StrEnum
from functools import cache
from reprlib import Repr
from typing import Any, NamedTuple, get_type_hints

from schemas.errors import did_you_mean

Path = tuple[str | int, ...]
"""Names of fields and indices of lists, from the outside in."""


class FaultKind(StrEnum):
    """The kind of a fault."""

    VALUE = "value"
    MISSING = "missing"
    UNKNOWN = "unknown"
    RULE = "rule"
    """A rule is broken. `expected` is a whole sentence, which names the value unless `value` is given as well."""


class Fault(NamedTuple):
    """One fault of some content."""

    path: Path
    """Where the fault is; empty for the content as a whole."""
    value: Any
    """The value found there."""
    expected: str
    """The valid values, in words."""
    kind: FaultKind = FaultKind.VALUE
    known: tuple[str, ...] = ()
    """Of an unknown field: the fields that exist."""

    @property
    def where(self) -> str:
        """The path with dots, `drive.vx`."""
        return ".".join(str(step) for step in self.path)

    def below(self, path: Path) -> "Fault":
        """The same fault in content that is nested at `path`."""
        return self._replace(path=(*path, *self.path))

    def sentence(self, remedy: str = "") -> str:
        """The fault in one line; `remedy`, an instruction, takes the place of what was expected."""
        where = self.where
        match self.kind:
            case FaultKind.MISSING:
                return f"{where} is missing; {remedy or 'it must be given'}"
            case FaultKind.UNKNOWN:
                others = f"; {did_you_mean(self.path[-1], self.known)}" if self.known else ""
                return f"{where} is not known{others}"
        if self.kind is FaultKind.RULE and not where:
            return self.expected
        if self.kind is FaultKind.RULE and self.value is None:
            return f"{where}: {self.expected}"
        return f"{where or 'it'} is {_SHOWN.repr(self.value)}; {remedy or self.expected}"


class FaultError(ValueError):
    """Invalid content."""

    def __init__(self, fault: Fault, owner: str = "") -> None:
        """`owner` is the name of the part with the fault, `drive` of `drive.vx`."""
        super().__init__((fault.below((owner,)) if owner and fault.path else fault).sentence())
        self.fault = fault


def not_json(text: str | bytes, reason: object) -> Fault:
    """The fault of a text that is not JSON."""
    return Fault((), text, f"{_SHOWN.repr(text)} is not JSON: {reason}", FaultKind.RULE)


@cache
def hints_of(kind: type) -> dict[str, Any]:
    """Field of a class → its type with its limits."""
    return get_type_hints(kind, include_extras=True)


_SHOWN = Repr()
_SHOWN.maxstring = _SHOWN.maxother = _SHOWN.maxlong = 60
_SHOWN.maxlevel = 3

PLAIN_TYPES: dict[Any, str] = {
    float: "a finite number",
    int: "a whole number",
    bool: "true or false",
    str: "text",
    types.NoneType: "null",
}
"""Type → its valid values, in words."""
