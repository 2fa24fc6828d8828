"""Formats the facts of a recording for a terminal."""

from recordings.inspection.recording_facts import RecordingFacts
from schemas.config.number_files import versioned_name
from schemas.config.task import score_text

HEADINGS = ("key", "message", "messages", "per s", "bytes", "lost")
"""Column headings for `key_rows`."""


def key_rows(facts: RecordingFacts) -> list[tuple[str, ...]]:
    """One row for each key, with the columns `HEADINGS`."""
    return [
        (key.key, key.message, str(key.messages), f"{key.rate:.1f}", str(key.bytes), str(key.lost))
        for key in facts.keys
    ]


def summary_lines(facts: RecordingFacts) -> list[tuple[str, str]]:
    """Name and value of each fact, without unknown ones."""
    goals = f"{facts.score['cyan']} : {facts.score['magenta']}" if facts.score is not None else None
    task = score_text(facts.value, facts.unit) if facts.value is not None else None
    values: dict[str, str | None] = {
        "match": facts.match,
        "teams": " – ".join(facts.teams.values()) or None,
        "score": ", of the task ".join(part for part in (goals, task) if part is not None) or None,
        "phase": facts.phase,
        "ended": facts.ended,
        "pace": facts.pace,
        "profile": versioned_name(facts.profile, facts.profile_version) if facts.profile is not None else None,
        "rules": versioned_name(facts.rules, facts.rules_version) if facts.rules is not None else None,
        "seed": str(facts.seed) if facts.seed is not None else None,
        "started": facts.started,
        "duration": f"{facts.duration:.2f} s simulated, from {facts.start:.2f} to {facts.end:.2f} s",
        "last tick": f"{facts.tick} at {facts.time:.2f} s" if facts.tick >= 0 else None,
        "messages": f"{facts.messages}, {facts.lost} lost, {facts.missed_before_start} sent before it began",
        "lost on": ", ".join(f"{key.key} {key.lost}" for key in facts.keys if key.lost) or None,
        "keys": " ".join([*facts.include, *(f"not {key}" for key in facts.exclude)]) or None,
        "made": facts.made if facts.made != "recorded" else None,
        "part": str(facts.part) if facts.part > 1 else None,
        "for viewers": " ".join(facts.drawn) or None,
        "damaged": ", ".join(facts.damaged) or None,
        "events": str(facts.events),
        "size": f"{facts.size} bytes" + ("" if facts.complete else ", cut off"),
    }
    facts_lines = [(name, value) for name, value in values.items() if value is not None]
    return facts_lines + [("contradiction", sentence) for sentence in facts.contradictions]
