"""What was typed in, as a message; a value that it may not have is named by its option."""

from typing import TypeVar

from schemas.errors import TouchlineError
from schemas.faults import FaultError, validated

ProcessKind = TypeVar("ProcessKind")


def message_from_options(kind: type[ProcessKind], **content: object) -> ProcessKind:
    """The message with this content.

    Raises:
        TouchlineError: a value that it may not have, or two that do not agree.
    """
    try:
        return validated(kind, content)
    except FaultError as error:
        fault = error.fault
        if fault.path:
            fault = fault._replace(path=("--" + str(fault.path[0]).replace("_", "-"), *fault.path[1:]))
        raise TouchlineError(fault.sentence()) from None
