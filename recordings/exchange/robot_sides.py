"""Which side each robot of a recording plays for."""

from recordings.container.applied_changes import changes_in
from recordings.reading.recording import Recording
from schemas.side import Side
from schemas.topics import APPLIED


def sides_of(recording: Recording) -> dict[str, Side]:
    """Robot → its side, for every robot that was there at any time: as the setup and each change of the roster say."""
    setup = recording.manifest.setup
    sides = {name: side for side, team in setup.teams.items() for name in team.robots} if setup is not None else {}
    for recorded in recording.messages(APPLIED.key):
        if changes_in(recorded.payload).robots is not None:
            roster = recorded.message().robots or []
            sides |= {entry.name: entry.side for entry in roster}
    return sides
