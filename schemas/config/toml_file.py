"""Files of people, read into a model: one line for what is wrong, with file, key, value and remedy."""

import json
import re
from collections.abc import Mapping
from typing import Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, ValidationError

from schemas.errors import TouchlineError, did_you_mean

M = TypeVar("M", bound=BaseModel)

_TYPE_STEPS = frozenset({"constrained-str", "str", "int", "float", "bool"})
"""Steps that the validator puts into a place to tell which type of several it tried."""


def validate_tables(model: type[M], content: Mapping[str, Any], where: str, remedies: Mapping[str, str]) -> M:
    """The model of what a TOML file holds; `where` names the file.

    Args:
        remedies: what to do about a wrong value, by its key without places in lists, as `robots.side`.

    Raises:
        TouchlineError: the first thing that is wrong.
    """
    try:
        return model.model_validate_json(json.dumps(content, default=str), strict=True)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise TouchlineError(f"{where}: {_sentence(model, first, remedies)}") from None


def _sentence(model: type[BaseModel], error: Any, remedies: Mapping[str, str]) -> str:
    steps = [step for step in error["loc"] if step not in _TYPE_STEPS]
    key = ".".join(str(step) for step in steps)
    message = re.sub(r"^Value error, ", "", error["msg"])
    if error["type"] == "extra_forbidden":
        parent = _model_at(model, steps[:-1])
        return f"{key} is not known; {did_you_mean(str(steps[-1]), parent.model_fields if parent is not None else ())}"
    if error["type"] == "missing":
        return f"{key} is missing; {remedies.get(_without_indices(key), 'it must be given')}"
    if not key:
        return message
    if error["type"] == "value_error" and isinstance(error["input"], dict):
        return f"{key}: {message}"  # of a whole table, what is said names what is wrong in it
    return f"{key} is {error['input']!r}; {remedies.get(_without_indices(key)) or message}"


def _without_indices(key: str) -> str:
    return re.sub(r"\.\d+(?=\.|$)", "", key)


def _model_at(model: type[BaseModel], path: list[Any]) -> type[BaseModel] | None:
    found: type[BaseModel] | None = model
    for step in path:
        if isinstance(step, int):
            continue  # a place in a list of the model that was found last
        field = found.model_fields.get(str(step)) if found is not None else None
        kind: Any = field.annotation if field is not None else None
        kind = get_args(kind)[0] if get_origin(kind) is list else kind
        found = kind if isinstance(kind, type) and issubclass(kind, BaseModel) else None
    return found
