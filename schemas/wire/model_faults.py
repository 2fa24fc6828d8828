"""Faults that pydantic finds in models of the configuration, in the words of `faults`."""

import re
import types
from collections.abc import Mapping
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

from schemas.wire.faults import PLAIN_TYPES, Fault, FaultError, FaultKind, Path, hints_of, not_json


def fault_of(error: ValidationError, kind: Any = None) -> Fault:
    """The first unknown, missing or invalid field of content for a `kind` of model."""
    found = error.errors(include_url=False)
    first = next((one for one in found if one["type"] == "extra_forbidden"), found[0])  # a misspelt one is missing, too
    path = tuple(step for step in first["loc"] if step not in _TYPE_STEPS)
    value, context = first["input"], first.get("ctx", {})
    match first["type"]:
        case "missing":
            return Fault(path, None, "", FaultKind.MISSING)
        case "extra_forbidden":
            return Fault(path, value, "", FaultKind.UNKNOWN, _field_names(_kind_at(kind, path[:-1])))
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


_TYPE_STEPS = frozenset({"constrained-str", "str", "int", "float", "bool"})
"""Steps in pydantic's locations that name which type of a union was tried."""

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
    """The model at a path in another."""
    for step in path:
        is_entry = get_origin(kind) in (list, dict)
        kind = _bare(get_args(kind)[-1] if is_entry else hints_of(kind).get(str(step)) if _field_names(kind) else None)
    return kind


def _field_names(kind: Any) -> tuple[str, ...]:
    """The fields of a model that people write: those that its representation has; empty for any other type."""
    fields = kind.model_fields if isinstance(kind, type) and issubclass(kind, BaseModel) else {}
    return tuple(name for name, field in fields.items() if field.repr)


def _bare(hint: Any) -> Any:
    """A type without its limits, and without None."""
    while get_origin(hint) in (Annotated, Union, types.UnionType):
        hint = next(choice for choice in get_args(hint) if choice is not types.NoneType)
    return hint
