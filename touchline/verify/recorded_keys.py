"""Which keys a recording should have, and which of them a verification does not compare."""

from recordings.container.key_selection import KeySelection
from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording
from recordings.reading.tick_records import manually_driven
from schemas.natural_order import natural_order
from schemas.topics import COMMAND, EVENT, STATE, WORLD
from touchline.verify.game_comparison import is_agent_event

_OF_PEOPLE_AND_PROCESSES = ("order", "standing_order", "health", "invalid", "sight")
"""Topics whose messages do not follow from the inputs of the world, or are not computed again."""


def is_recorded(recording: Recording, key: str) -> bool:
    """Whether the messages of a key were selected for the recording."""
    return KeySelection(tuple(recording.manifest.include), tuple(recording.manifest.exclude)).includes(key)


def not_checked(recording: Recording, *, referee: bool, why_no_referee: str) -> list[str]:
    """What a verification does not compare, as phrases; `referee` if the referee is simulated, too."""
    found = []
    if not referee:
        found.append(f"{STATE.key}, {EVENT.key}, and clock, episode and off_field of {WORLD.key} ({why_no_referee})")
    compared = (WORLD.key, STATE.key, EVENT.key) if referee else (WORLD.key,)
    found += [f"{key} (not recorded)" for key in compared if not is_recorded(recording, key)]
    driven = sorted(manually_driven(recording), key=natural_order)
    if driven:
        found.append(f"inputs of {', '.join(driven)} (under manual control, which is not recorded)")
    if referee:
        agents = sum(is_agent_event(event) for _, event in recording.decoded(EVENT.key))
        found += [f"{agents} events of agents"] if agents else []
    keys = [channel.key for channel in recording.channels if channel.messages]
    topics = {channel.key: channel.topic for channel in recording.channels}
    found += [key for key in keys if topics[key] in _OF_PEOPLE_AND_PROCESSES]
    found += _incomplete(recording)
    if recording.result is None:
        found.append("what the match had after the end of the file (cut off, without a result)")
    if recording.damaged_records:
        found.append(f"messages in {recording.damaged_records} damaged records that a repair has left out")
    setup = recording.manifest.setup
    if setup is not None and setup.sensors and config_of(recording) is None:
        found.append("readings of sensors (the seed is missing: it is in the match file)")
    if recording.drawn:
        found.append("drawings for viewers")
    return [*found, "wall times"]


def _incomplete(recording: Recording) -> list[str]:
    """Commands and beliefs of robots whose commands are not all in the file."""
    counts = recording.result.keys if recording.result is not None else {}
    commands = {channel.key for channel in recording.channels if channel.topic == "command" and channel.messages}
    beliefs = {channel.key for channel in recording.channels if channel.topic == "belief" and channel.messages}
    found = []
    for key in sorted(beliefs, key=natural_order):
        robot = key.rsplit("/", 1)[1]
        command = COMMAND.fill(robot=robot)
        count = counts.get(command)
        if command not in commands or count is None or count.lost or count.missed_before_start or count.restarts:
            found.append(f"{key} (commands of {robot} are missing)")
    return found
