"""How a referee box of the league writes its commands."""

from enum import StrEnum


class BoxProtocol(StrEnum):
    """The protocol of a referee box."""

    AUTO = "auto"
    """Detected by the first bytes: JSON begins with a brace."""
    JSON = "json"
    CHARACTERS = "characters"
