"""Files of people, read into a model: one line for what is wrong, with file, key, value and remedy."""

import json
import re
from collections.abc import Mapping
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from schemas.errors import TouchlineError
from schemas.faults import fault_of

M = TypeVar("M", bound=BaseModel)


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
        fault = fault_of(error, model)
        remedy = remedies.get(re.sub(r"\.\d+(?=\.|$)", "", fault.where), "")
        raise TouchlineError(f"{where}: {fault.sentence(remedy)}") from None
