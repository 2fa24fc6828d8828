"""What was typed in, as a message; a value that it may not have is named by its option."""

from typing import TypeVar

from pydantic import BaseModel, ValidationError

from schemas.errors import TouchlineError
from schemas.message import reason_of

Model = TypeVar("Model", bound=BaseModel)


def message_from_options(model: type[Model], **content: object) -> Model:
    """The message with this content.

    Raises:
        TouchlineError: a value that it may not have, or two that do not agree.
    """
    try:
        return model.model_validate(content)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        if not first["loc"]:
            raise TouchlineError(reason_of(error)) from None
        option = "--" + "-".join(str(first["loc"][0]).split("_"))
        raise TouchlineError(f"{option} is {first['input']}: {first['msg'][0].lower()}{first['msg'][1:]}") from None
