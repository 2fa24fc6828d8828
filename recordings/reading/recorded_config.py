"""The match file of a recording, with the numbers of its match: the attached profile and rule book."""

from typing import Any

from pydantic_core import from_json

from recordings.container.attachments import PROFILE, RULE_BOOK
from recordings.reading.recording import Recording
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError


def config_of(recording: Recording) -> MatchConfig | None:
    """The config of a recording with its attached profile and rule book; None if the config was not recorded.

    Without an attachment, the numbers are the shipped ones, if those have the version of the recording.

    Raises:
        TouchlineError: an attachment is damaged or lost, and this program has the numbers of another version.
    """
    config, setup = recording.manifest.config, recording.manifest.setup
    if config is None:
        return None
    profile = _attached(recording, PROFILE) or config.profile_tables
    book = _attached(recording, RULE_BOOK) or config.rule_book_tables
    if setup is not None and profile is None:
        shipped = load_profile(config.profile).version
        _check_version(recording, PROFILE, f"the profile {config.profile}", shipped, setup.profile_version)
    if setup is not None and book is None:
        shipped = load_rule_book(config.rules).version
        _check_version(recording, RULE_BOOK, f"the rule book {config.rules}", shipped, setup.rules_version)
    return config.model_copy(update={"profile_tables": profile, "rule_book_tables": book})


def _check_version(recording: Recording, attachment: str, what: str, shipped: int, recorded: int) -> None:
    if shipped != recorded:
        raise TouchlineError(
            f"{recording.path}: its attached {attachment} is missing or damaged, and {what} has version {shipped} in "
            f"this program, {recorded} in the recording; use another copy of the recording"
        )


def _attached(recording: Recording, name: str) -> dict[str, Any] | None:
    """The tables in an attachment; None if there is no such attachment."""
    text = recording.attachments.get(name)
    if text is None:
        return None
    try:
        return dict(from_json(text))
    except (ValueError, TypeError):
        raise TouchlineError(f"{recording.path}: the attached {name} is damaged; use another copy") from None
