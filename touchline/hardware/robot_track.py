"""What one robot perceived and commanded in a recording, of a match with its sights, or of keys."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from recordings.container.parted_file import open_parts
from schemas.errors import TouchlineError, did_you_mean
from schemas.frames import Pose
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SIGHT
from schemas.wire.message import valid


class RobotTrack(NamedTuple):
    """Sights in order of their times, and the command that answers each."""

    robot: str
    sights: list[Sight]
    commands: list[Command | None]
    """Per sight: its answer; None where there is none."""


def read_track(path: Path, robot: str) -> RobotTrack:
    """The track of a robot in a recording.

    Raises:
        TouchlineError: the file cannot be read, or has no sights of this robot.
    """
    file = open_parts(path)
    keys = {channel.key for channel in file.channels.values()}
    own = {topic: topic.fill(robot=robot) for topic in (SIGHT, COMMAND)}
    wanted = {topic: {key for key in keys if key == end or key.endswith("/" + end)} for topic, end in own.items()}
    if not wanted[SIGHT]:
        others = sorted({key.split("/")[-2] for key in keys if key.endswith("/sight")})
        remedy = did_you_mean(robot, others) if others else "record with --sights, or robots on hardware with --keys"
        raise TouchlineError(f"{path}: no sights of {robot}; {remedy}")
    sights: dict[int, Sight] = {}
    commands: dict[int, Command] = {}
    for key, message in file.messages(wanted[SIGHT] | wanted[COMMAND]):
        if key in wanted[SIGHT]:
            sight = valid(Sight.decode, message.data)
            if sight is not None:
                sights[sight.tick] = sight
        elif (command := valid(Command.decode, message.data)) is not None:
            commands[command.answers_tick] = command
    ordered = [sights[tick] for tick in sorted(sights)]
    return RobotTrack(robot, ordered, [commands.get(sight.tick) for sight in ordered])


def pose_of(sight: Sight) -> Pose:
    """Where the robot believed itself, in its team frame."""
    return Pose(sight.self.x, sight.self.y, sight.self.heading)


def path_distance(one: RobotTrack, other: RobotTrack) -> tuple[float, float]:
    """The mean and the largest distance in m of the places of one path from the nearest of another, both ways."""
    paths = [np.array([complex(sight.self.x, sight.self.y) for sight in track.sights]) for track in (one, other)]
    away = np.abs(paths[0][:, None] - paths[1])
    nearest = np.concatenate((away.min(axis=0), away.min(axis=1)))
    return float(nearest.mean()), float(nearest.max())
