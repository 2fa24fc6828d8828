"""What stands at the head of a recording, before the first message: its manifest, and the files attached to it."""

from datetime import UTC, datetime

from pydantic_core import to_json

from recordings.environment import libm_fingerprint, versions
from recordings.json_schema import whole_schema
from recordings.manifest import Manifest
from recordings.selection import EVERYTHING, Selection
from schemas.clock import Clock
from schemas.host import Setup
from schemas.match_config import MatchConfig
from schemas.message import VERSION, Message
from schemas.profile import profile_tables
from schemas.rule_book import rule_book_text
from schemas.topic import Delivery
from schemas.topics import TOPICS

PROFILE = "profile.json"
"""The attachment with the whole profile: laid over those that it extends, as `schemas.profile.profile_of` reads it."""


def manifest_of(
    match: str,
    recorder: str,
    clock: Clock,
    setup: Setup | None,
    config: MatchConfig | None,
    *,
    sights: bool,
    selection: Selection = EVERYTHING,
) -> Manifest:
    """The manifest of a recording that begins now, on this machine."""
    return Manifest(
        contract=VERSION,
        match=match,
        recorder=recorder,
        started=date(clock),
        sights=sights,
        versions=versions(),
        libm=libm_fingerprint(),
        setup=setup,
        config=config,
        include=list(selection.include),
        exclude=list(selection.exclude),
    )


def attachments(config: MatchConfig | None) -> dict[str, bytes]:
    """What goes into the file beside the messages: their whole schemas, the match file, profile and rule book."""
    models: dict[str, type[Message]] = {
        topic.message.__name__: topic.message
        for topic in TOPICS.values()
        if topic.message is not None and topic.delivery is not Delivery.QUERY  # questions are in no recording
    }
    files = {"message_schemas.json": to_json({name: whole_schema(model) for name, model in models.items()})}
    if config is not None:
        files["match.json"] = to_json(config)
        files[PROFILE] = to_json(config.profile_tables or profile_tables(config.profile))
        files["rules.toml"] = rule_book_text(config.rules).encode()
    return files


def date(clock: Clock) -> str:
    """The clock's wall time, ISO 8601, UTC, to the millisecond."""
    return datetime.fromtimestamp(clock.unix_ns() / 1e9, UTC).isoformat(timespec="milliseconds")
