"""Faults of invalid content: one plain sentence with the field, its value and what was expected.

The one formatter for all content from outside: payloads, files, options and pages. The faults of pydantic models are
found here, faults of msgspec structs in `struct_faults`.
"""

import re
import types
from collections.abc import Mapping
from enum import StrEnum
from functools import cache
from reprlib import Repr
from typing import Annotated, Any, NamedTuple, TypeVar, Union, get_args, get_origin, get_type_hints

import msgspec
from pydantic import BaseModel, ValidationError

from schemas.errors import did_you_mean

T = TypeVar("T")

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
                others = f"; {did_you_mean(str(self.path[-1]), self.known)}" if self.known else ""
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


def fault_of(error: ValidationError, kind: Any = None) -> Fault:
    """The first fault that pydantic found in content for a `kind` of model."""
    first = error.errors(include_url=False)[0]
    path = tuple(step for step in first["loc"] if step not in _TYPE_STEPS)
    value, context = first["input"], first.get("ctx", {})
    match first["type"]:
        case "missing":
            return Fault(path, None, "", FaultKind.MISSING)
        case "extra_forbidden":
            return Fault(path, value, "", FaultKind.UNKNOWN, field_names(_kind_at(kind, path[:-1])))
        case "value_error":
            inner = context.get("error")
            if isinstance(inner, FaultError):
                return inner.fault.below(path)
            return Fault(path, None if isinstance(value, Mapping | BaseModel) else value, str(inner), FaultKind.RULE)
        case "union_tag_not_found":
            return Fault((*path, *_quoted(context["discriminator"])), None, "", FaultKind.MISSING)
        case "union_tag_invalid":
            tags = ", ".join(_quoted(context["expected_tags"]))
            return Fault((*path, *_quoted(context["discriminator"])), context["tag"], f"one of {tags}")
        case "json_invalid":
            return not_json(value, context["error"])
    if "expected" in context:
        context = {"expected": ", ".join(_quoted(context["expected"]))}
    template = _EXPECTED.get(first["type"])
    return Fault(path, value, template.format_map(context) if template is not None else without_jargon(first["msg"]))


def not_json(text: str | bytes, reason: object) -> Fault:
    """The fault of a text that is not JSON."""
    return Fault((), text, f"{_SHOWN.repr(text)} is not JSON: {reason}", FaultKind.RULE)


def field_names(kind: Any) -> tuple[str, ...]:
    """The fields of a model or a struct; empty for any other type."""
    if not isinstance(kind, type):
        return ()
    if issubclass(kind, BaseModel):
        return tuple(kind.model_fields)
    return kind.__struct_fields__ if issubclass(kind, msgspec.Struct) else ()


@cache
def hints_of(kind: type) -> dict[str, Any]:
    """Field of a class → its type with its limits."""
    return get_type_hints(kind, include_extras=True)


_SHOWN = Repr()
_SHOWN.maxstring = _SHOWN.maxother = _SHOWN.maxlong = 60
_SHOWN.maxlevel = 3

_TYPE_STEPS = frozenset({"constrained-str", "str", "int", "float", "bool"})
"""Steps in pydantic's locations that name which type of a union was tried."""

PLAIN_TYPES: dict[Any, str] = {
    float: "a finite number",
    int: "a whole number",
    bool: "true or false",
    str: "text",
    types.NoneType: "null",
}
"""Type → its valid values, in words."""

_EXPECTED = {
    "greater_than_equal": "at least {ge:g}",
    "greater_than": "above {gt:g}",
    "less_than_equal": "at most {le:g}",
    "less_than": "below {lt:g}",
    "finite_number": PLAIN_TYPES[float],
    "float_type": PLAIN_TYPES[float],
    "float_parsing": PLAIN_TYPES[float],
    "int_type": PLAIN_TYPES[int],
    "int_parsing": PLAIN_TYPES[int],
    "int_from_float": PLAIN_TYPES[int],
    "bool_type": PLAIN_TYPES[bool],
    "bool_parsing": PLAIN_TYPES[bool],
    "string_type": PLAIN_TYPES[str],
    "list_type": "a list",
    "dict_type": "an object",
    "model_type": "an object",
    "model_attributes_type": "an object",
    "dataclass_type": "an object",
    "enum": "one of {expected}",
    "literal_error": "one of {expected}",
    "string_pattern_mismatch": "text of the form {pattern}",
    "string_too_long": "text of at most {max_length} characters",
    "string_too_short": "text of at least {min_length} characters",
    "too_long": "at most {max_length} entries",
    "too_short": "at least {min_length} entries",
}
"""Error type of pydantic → what was expected, a template for the error's context."""


def _quoted(text: str) -> list[str]:
    """The words in quotes."""
    return re.findall(r"'([^']*)'", text)


def without_jargon(message: str) -> str:
    """A message of pydantic or msgspec without the words that only concern programmers."""
    plain = re.sub(r"^(Input should be|Value error,) ", "", message)
    return plain[:1].lower() + plain[1:]


def _kind_at(kind: Any, path: Path) -> Any:
    """The model or struct at a path in another."""
    for step in path:
        is_entry = get_origin(kind) in (list, dict)
        kind = _bare(get_args(kind)[-1] if is_entry else hints_of(kind).get(str(step)) if field_names(kind) else None)
    return kind


def _bare(hint: Any) -> Any:
    """A type without its limits, and without None."""
    while get_origin(hint) in (Annotated, Union, types.UnionType):
        hint = next(choice for choice in get_args(hint) if choice is not types.NoneType)
    return hint
