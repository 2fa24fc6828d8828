"""The side that each robot of a recording plays for."""

from recordings.container.applied_changes import changes_in
from recordings.container.lineup import Lineup
from recordings.reading.recording import Recording
from schemas.side import Side
from schemas.topics import APPLIED


def sides_of(recording: Recording) -> dict[str, Side]:
    """Robot → its side, for every robot that took part at any time."""
    lineup = Lineup.of(recording.manifest.setup)
    for recorded in recording.messages(APPLIED.key):
        if changes_in(recorded.payload).robots is not None:
            lineup = lineup.changed(recorded.message().robots or [])
    return {name: robot.side for name, robot in lineup.robots.items()}
