"""The files attached to a recording, before its first message."""

from recordings.container.json_schema import whole_schema
from schemas.config.match_config import MatchConfig
from schemas.config.profile import FILES as PROFILES
from schemas.config.soccer.rule_book import FILES as RULE_BOOKS
from schemas.topic import Delivery
from schemas.topics import TOPICS
from schemas.wire.message import Message
from schemas.wire.part import encode

MEDIA_TYPES = {".json": "application/json", ".toml": "application/toml"}
"""Suffix of an attachment → its media type."""
PROFILE = "profile.json"
"""The attachment with the profile and the profiles that it extends, for `schemas.config.profile.profile_of`."""
RULE_BOOK = "rules.json"
"""The attachment with the rule book and those that it extends, for `schemas.config.soccer.rule_book.rule_book_of`."""


def make_attachments(config: MatchConfig | None) -> dict[str, bytes]:
    """Return the full schemas of all messages, and match file, profile and rule book if there is a `config`."""
    models: dict[str, type[Message]] = {
        topic.message.__name__: topic.message
        for topic in TOPICS.values()
        if topic.message is not None and topic.delivery is not Delivery.QUERY  # queries are not recorded
    }
    files = {"message_schemas.json": encode({name: whole_schema(model) for name, model in models.items()})}
    if config is not None:
        files["match.json"] = encode(config)
        files[PROFILE] = encode(config.profile_tables or PROFILES.tables(config.profile))
        files[RULE_BOOK] = encode(config.rule_book_tables or RULE_BOOKS.tables(config.rules))
    return files
