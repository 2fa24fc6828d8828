"""Finds where a recording contradicts itself: its sealed result, its manifest, its attachments, its messages."""

from collections.abc import Iterator
from typing import Any

from recordings.container.manifest import MANIFEST, EndReason, KeyCount, Result
from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording
from recordings.recorder.sequence_tracker import LossCounts
from schemas.config.soccer.rule_book import SECTIONS as RULE_SECTIONS
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameState
from schemas.natural_order import natural_order
from schemas.topics import APPLIED, STATE
from schemas.wire.part import json_object

_ENDS = (EndReason.FULL_TIME, EndReason.HOST_GONE, EndReason.STOPPED)
"""Ends of a recording whose result describes the last messages of the file."""
_FROM_MATCH_FILE = ("pace", "rules", "duration", "referee", "officiating")
"""Fields of the setup that no operator can change."""
_FROM_PROFILE = {"time": "time", "pitch": "field", "robot": "robot", "ball": "ball"}
"""Field of the setup → section of the profile that it repeats."""
_FROM_RULE_BOOK = tuple(RULE_SECTIONS)
"""Fields of the setup that are sections of the rule book."""


def contradictions(recording: Recording) -> list[str]:
    """Sentences on where result, manifest and attachments do not fit the messages and each other.

    Reads the summary and the end of the file only.
    """
    found = [f"the attachment {name} is missing or has changed" for name in recording.damaged]
    found += _of_match_file(recording)
    found += _of_setup(recording)
    if recording.result is not None:
        found += _of_counts(recording.result, recording)
        found += _of_ending(recording.result, recording)
    return found


def record_faults(recording: Recording) -> list[str]:
    """Sentences on messages that are out of order, or whose numbers do not fit the losses in the result.

    Reads all messages.
    """
    counts = LossCounts()
    found: list[str] = []
    log_ns, before = -1, ""
    for recorded in recording.messages(start=recording.manifest.begins_ns / 1e9):
        if recorded.log_ns < log_ns and not found:
            found.append(
                f"{recorded.key} {recorded.sequence} at {recorded.time:.9g} s follows {before} at {log_ns / 1e9:.9g} s"
            )
        log_ns, before = recorded.log_ns, recorded.key
        counts.add([recorded])
    result = recording.result
    if result is None or not result.keys or recording.manifest.part > 1:
        return found  # the counts of a later part are those of the whole recording
    there = counts.counts()
    for key in sorted({*there, *result.keys}, key=natural_order):
        count, sealed = there.get(key, KeyCount()), result.keys.get(key, KeyCount())
        found += [
            f"{key}: {getattr(count, name)} {name} in the file, {getattr(sealed, name)} in the result"
            for name in ("messages", "bytes", "lost", "duplicates")
            if getattr(count, name) != getattr(sealed, name)
        ]
    return found


def _of_match_file(recording: Recording) -> Iterator[str]:
    """The match file in the manifest and the attached one, as they were written."""
    text, attached = recording.mcap_file.metadata[MANIFEST].get("config"), recording.attachments.get("match.json")
    if text is None or attached is None:
        return
    ours, theirs = json_object(text), json_object(attached)
    different = [name for name in {**ours, **theirs} if ours.get(name) != theirs.get(name)]
    if different:
        values = ", ".join(f"{name} is {ours.get(name)} and {theirs.get(name)}" for name in different[:3])
        yield f"the manifest and the attached match.json differ: {values}"


def _of_setup(recording: Recording) -> Iterator[str]:
    """The setup that the host reported, and what follows from the match file."""
    setup = recording.manifest.setup
    if setup is None:
        return
    try:
        config = config_of(recording)
        if config is None:
            return
        profile = config.load_profile().with_types(config.types, f'match "{config.name}"')
        book = config.load_rule_book()
        expected = Setup.of(config, profile, book)
    except TouchlineError as error:
        yield f"the numbers of the match cannot be read: {error}"
        return
    different = [name for name in _FROM_MATCH_FILE if getattr(setup, name) != getattr(expected, name)]
    if not setup.parameters:
        different += [
            name for name, section in _FROM_PROFILE.items() if getattr(setup, name) != getattr(profile, section)
        ]
    different += [name for name in _FROM_RULE_BOOK if getattr(setup, name) != getattr(book, name)]
    names = {side: team.name for side, team in setup.teams.items()}
    if names != {side: team.name for side, team in expected.teams.items()}:
        different.append("teams")
    if different:
        yield f"the setup does not follow from the match file: {', '.join(different)}"


def _of_counts(result: Result, recording: Recording) -> Iterator[str]:
    """The counts in the result, and the counts of the file."""
    if not result.keys or recording.manifest.begins_ns:
        return  # of a repaired file, or with messages from before its beginning, which are in no count
    there = {channel.key: channel.messages for channel in recording.channels if channel.messages}
    for key in sorted({*there, *result.keys}, key=natural_order):
        sealed = result.keys.get(key, KeyCount()).messages
        if there.get(key, 0) != sealed:
            yield f"{key}: {there.get(key, 0)} messages in the file, {sealed} in the result"
    counted = result.counted(result.keys)
    for name in ("messages", "lost", "events"):
        if getattr(result, name) != getattr(counted, name):
            yield f"the result has {getattr(result, name)} {name}, and {getattr(counted, name)} on its keys"


def _of_ending(result: Result, recording: Recording) -> Iterator[str]:
    """Score, phase and last tick in the result, and in the last messages."""
    if result.ended not in _ENDS or recording.manifest.made != "recorded":
        return
    state: GameState | None = recording.last(STATE.key)
    if state is not None:
        for name in ("score", "value", "phase"):
            sealed, recorded = getattr(result, name), getattr(state, name)
            if sealed != recorded:
                yield f"the {name} is {_text(sealed)} in the result, {_text(recorded)} in the last {STATE.key}"
    applied: Applied | None = recording.last(APPLIED.key)
    if applied is not None and applied.tick != result.tick:
        yield f"the last tick is {result.tick} in the result, {applied.tick} in the last {APPLIED.key}"


def _text(value: Any) -> str:
    return f"{value.cyan} : {value.magenta}" if hasattr(value, "cyan") else str(value)
