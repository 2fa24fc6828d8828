"""Faults of invalid content: one plain sentence with the field, its value and what was expected.

The one formatter for pydantic models and msgspec structs, and for all content from outside: payloads, files, options
and pages.
"""

import math
import re
import types
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum, StrEnum
from functools import cache
from reprlib import Repr
from typing import Annotated, Any, NamedTuple, TypeVar, Union, cast, get_args, get_origin, get_type_hints

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


def validated(kind: type[T], content: Mapping[str, Any]) -> T:
    """A message or a part, model or struct, with this content.

    Raises:
        FaultError: the content is invalid.
    """
    if issubclass(kind, BaseModel):
        try:
            return cast(T, kind.model_validate(content))
        except ValidationError as error:
            raise FaultError(fault_of(error, kind)) from None
    try:
        return msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        raise FaultError(fault_in(kind, content) or _msgspec_fault(error)) from None


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
    return Fault(path, value, template.format_map(context) if template is not None else _without_jargon(first["msg"]))


def not_json(text: str | bytes, reason: object) -> Fault:
    """The fault of a text that is not JSON."""
    return Fault((), text, f"{_SHOWN.repr(text)} is not JSON: {reason}", FaultKind.RULE)


def fault_in(hint: Any, value: Any) -> Fault | None:
    """The first fault of a value for a field or a struct of this type; None where it has none.

    Slow, for explanations only: the error of msgspec names neither the entry of a mapping nor the valid values.
    """
    kind, inner = get_origin(hint), get_args(hint)
    if kind is Annotated and get_origin(inner[0]) is not None:
        return fault_in(inner[0], value) or _leaf(hint, value)
    if kind in (Union, types.UnionType):
        return _of_choices(hint, [choice for choice in inner if choice is not types.NoneType], value)
    if isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        return _of_struct(hint, value)
    if kind is list and isinstance(value, Sequence) and not isinstance(value, str):
        return _first((place, fault_in(inner[0], item)) for place, item in enumerate(value))
    if kind is dict and isinstance(value, Mapping):
        keys = ((str(name), fault_in(inner[0], name)) for name in value)
        return _first(keys) or _first((str(name), fault_in(inner[1], item)) for name, item in value.items())
    return _leaf(hint, value)


def expected(hint: Any) -> str:
    """The valid values of a field of this type, in words: `m/s from -20 to 20`."""
    kind, inner = get_origin(hint), get_args(hint)
    if kind is Annotated:
        return _limited(inner[0], [one for one in inner[1:] if isinstance(one, msgspec.Meta)])
    if kind in (Union, types.UnionType):
        implied = {types.NoneType, int} if float in inner else {types.NoneType}
        return " or ".join(expected(choice) for choice in inner if choice not in implied)
    if isinstance(hint, type) and issubclass(hint, Enum):
        return f"one of {', '.join(str(member.value) for member in hint)}"
    return _PLAIN.get(hint, "a list" if kind is list else "an object")


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

_PLAIN: dict[Any, str] = {
    float: "a finite number",
    int: "a whole number",
    bool: "true or false",
    str: "text",
    types.NoneType: "null",
}

_EXPECTED = {
    "greater_than_equal": "at least {ge:g}",
    "greater_than": "above {gt:g}",
    "less_than_equal": "at most {le:g}",
    "less_than": "below {lt:g}",
    "finite_number": _PLAIN[float],
    "float_type": _PLAIN[float],
    "float_parsing": _PLAIN[float],
    "int_type": _PLAIN[int],
    "int_parsing": _PLAIN[int],
    "int_from_float": _PLAIN[int],
    "bool_type": _PLAIN[bool],
    "bool_parsing": _PLAIN[bool],
    "string_type": _PLAIN[str],
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


def _without_jargon(message: str) -> str:
    plain = re.sub(r"^(Input should be|Value error,) ", "", message)
    return plain[:1].lower() + plain[1:]


def _msgspec_fault(error: Exception) -> Fault:
    """The fault in the words of msgspec's error."""
    return Fault((), None, _without_jargon(str(error).partition(" - at ")[0]), FaultKind.RULE)


def _first(faults: Iterable[tuple[str | int, Fault | None]]) -> Fault | None:
    return next((fault.below((step,)) for step, fault in faults if fault is not None), None)


def _of_struct(kind: type[msgspec.Struct], value: Any) -> Fault | None:
    """The first unknown, missing or invalid field; then the rules over several fields."""
    if isinstance(value, kind):
        value = msgspec.structs.asdict(value)
    if not isinstance(value, Mapping):
        return Fault((), value, expected(kind))
    hints = hints_of(kind)
    for name in value:
        if name not in kind.__struct_fields__:
            return Fault((str(name),), value[name], "", FaultKind.UNKNOWN, kind.__struct_fields__)
    for field in msgspec.structs.fields(kind):
        if field.name not in value and field.required:
            return Fault((field.name,), None, "", FaultKind.MISSING)
    fault = _first((name, fault_in(hints[name], item)) for name, item in value.items())
    return fault or _rule(kind, value)


def _rule(kind: type[msgspec.Struct], content: Mapping[str, Any]) -> Fault | None:
    try:
        msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        cause = error.__cause__
        return cause.fault if isinstance(cause, FaultError) else _msgspec_fault(error)
    return None


def _of_choices(hint: Any, choices: Sequence[Any], value: Any) -> Fault | None:
    if len(choices) == 1:
        return None if value is None else fault_in(choices[0], value)
    return None if any(fault_in(choice, value) is None for choice in choices) else Fault((), value, expected(hint))


def _leaf(hint: Any, value: Any) -> Fault | None:
    try:
        converted = msgspec.convert(value, hint)
    except msgspec.ValidationError:
        return Fault((), value, expected(hint))
    is_finite = not isinstance(converted, float) or math.isfinite(converted)
    return None if is_finite else Fault((), value, expected(hint))


def _limited(kind: Any, limits: Sequence[msgspec.Meta]) -> str:
    """A type with limits, in words."""
    declared = {key: value for one in limits for key in _LIMITS if (value := getattr(one, key)) is not None}
    unit = next((one.extra["unit"] for one in limits if one.extra and "unit" in one.extra), "")
    if "description" in declared:
        return str(declared["description"])
    if kind not in (int, float):
        most = declared.get("max_length")
        return expected(kind) + (
            "" if most is None else f" of at most {most} {'characters' if kind is str else 'entries'}"
        )
    low, high = declared.get("ge"), declared.get("le")
    words = [] if low is None else [f"from {_figure(low)}"]
    words += [f"above {_figure(declared['gt'])}"] if "gt" in declared else []
    if high is not None:
        words.append(f"to {_figure(high)}" if low is not None else f"at most {_figure(high)}")
    if not words:
        return f"{_PLAIN[kind]} in {unit}" if unit else _PLAIN[kind]
    noun = unit or ("a whole number" if kind is int else "a number")
    return f"{noun} {(' ' if low is not None else ', ').join(words)}"


def _figure(number: float) -> str:
    return str(number) if isinstance(number, int) else f"{number:g}"


_LIMITS = ("ge", "gt", "le", "max_length", "description")


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
