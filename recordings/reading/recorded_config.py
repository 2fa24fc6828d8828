"""The match file of a recording, with the numbers of its match: the attached profile and rule book."""

import tomllib
from collections.abc import Mapping
from typing import Any

from pydantic_core import from_json

from recordings.container.attachments import PROFILE, RULE_BOOK, UNVERSIONED_RULE_BOOK
from recordings.reading.recording import Recording
from schemas.config.match_config import MatchConfig
from schemas.config.number_files import UNVERSIONED
from schemas.config.profile import load_profile
from schemas.config.quantity import merge_tables
from schemas.config.rule_book import load_rule_book, unversioned_tables
from schemas.errors import TouchlineError


def config_of(recording: Recording) -> MatchConfig | None:
    """The config of a recording with its attached profile and rule book; None if the config was not recorded.

    Raises:
        TouchlineError: an attachment is damaged or lost, and this program has the numbers of another version.
    """
    config = recording.manifest.config
    if config is None:
        return None
    tables = {
        "profile_tables": _profile_tables(recording, config),
        "rule_book_tables": _rule_book_tables(recording, config),
    }
    return config.model_copy(update=tables)


def _profile_tables(recording: Recording, config: MatchConfig) -> dict[str, Any] | None:
    """The recorded tables of the profile; None for the shipped one, which has the version of the recording."""
    tables = _attached(recording, PROFILE) or config.profile_tables
    setup = recording.manifest.setup
    if tables is None and setup is not None and setup.profile_version != UNVERSIONED:
        shipped = load_profile(config.profile).version
        _check_version(recording, PROFILE, f"the profile {config.profile}", shipped, setup.profile_version)
    return tables


def _rule_book_tables(recording: Recording, config: MatchConfig) -> dict[str, Any] | None:
    """The recorded tables of the rule book; None for the shipped one, which has the version of the recording."""
    tables = _attached(recording, RULE_BOOK)
    if tables is not None:
        return tables
    if UNVERSIONED_RULE_BOOK in recording.attachments:
        return _unversioned(recording)
    if config.rule_book_tables is not None:
        return config.rule_book_tables
    setup = recording.manifest.setup
    version = setup.rules_version if setup is not None else UNVERSIONED
    if version == UNVERSIONED:
        return unversioned_tables(config.rules)
    shipped = load_rule_book(config.rules).version
    _check_version(recording, RULE_BOOK, f"the rule book {config.rules}", shipped, version)
    return None


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
        raise _damaged(recording, name) from None


def _unversioned(recording: Recording) -> dict[str, Any]:
    """The tables of a rule book from before versions: its own text, merged into what it extended then."""
    try:
        tables: Mapping[str, Any] = tomllib.loads(recording.attachments[UNVERSIONED_RULE_BOOK].decode())
    except (tomllib.TOMLDecodeError, UnicodeDecodeError):
        raise _damaged(recording, UNVERSIONED_RULE_BOOK) from None
    own = {key: value for key, value in tables.items() if key != "extends"}
    parent = tables.get("extends")
    return own if parent is None else merge_tables(unversioned_tables(str(parent)), own)


def _damaged(recording: Recording, name: str) -> TouchlineError:
    return TouchlineError(f"{recording.path}: the attached {name} is damaged; use another copy")
