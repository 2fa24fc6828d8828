"""Validation of TOML files: one line for the first fault, with file, key, value and remedy."""

import json
import re
from collections.abc import Mapping
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from schemas.errors import TouchlineError
from schemas.wire.faults import fault_of

M = TypeVar("M", bound=BaseModel)


def validate_tables(model: type[M], content: Mapping[str, Any], where: str, remedies: Mapping[str, str]) -> M:
    """The model of the content of a TOML file; `where` names the file.

    Args:
        remedies: key without indices of lists, `robots.side` → remedy for an invalid value.

    Raises:
        TouchlineError: the first fault.
    """
    try:
        return model.model_validate_json(json.dumps(content, default=str), strict=True)
    except ValidationError as error:
        fault = fault_of(error, model)
        remedy = remedies.get(re.sub(r"\.\d+(?=\.|$)", "", fault.where), "")
        raise TouchlineError(f"{where}: {fault.sentence(remedy)}") from None
