"""The observation of a robot: a vector of fixed length that is made of one sight."""

from itertools import chain

import numpy as np
from numpy.typing import NDArray

from robot_agent.sdk.contract import Briefing
from schemas.messages.sight import Sight
from touchline.policy.entries import BodyFrame, Entry
from touchline.policy.groups import OF_MATCH, OF_SENSOR, WITH_BALL, Group, has_ball
from touchline.policy.interface import Interface


class Observation:
    """The layout of a robot's observations, which its briefing determines."""

    def __init__(self, briefing: Briefing) -> None:
        """The entries that this robot of this match has.

        Raises:
            TouchlineError: a parameter of the team is no valid setting of a policy.
        """
        self._groups: list[Group] = []
        for name in Interface.of(briefing.parameters).observe:
            if name == "sensors":
                sensors = briefing.setup.sensors_of(briefing.robot)
                self._groups += [OF_SENSOR[sensor.kind](key, sensor) for key, sensor in sensors.items()]
            elif name not in WITH_BALL or has_ball(briefing):
                self._groups.append(OF_MATCH[name](briefing))
        self.entries: tuple[Entry, ...] = tuple(chain.from_iterable(group.entries for group in self._groups))
        """One for each number, in order."""
        self.low = np.array([entry.low for entry in self.entries], np.float32)
        """Least numbers, shape (entries,)."""
        self.high = np.array([entry.high for entry in self.entries], np.float32)
        """Largest numbers, shape (entries,)."""

    @property
    def names(self) -> list[str]:
        """Names of the entries, in order."""
        return [entry.name for entry in self.entries]

    def observe(self, sight: Sight) -> NDArray[np.float32]:
        """The observation of a sight: a new array of shape (entries,), within `low` and `high`."""
        frame = BodyFrame.of(sight.self)
        numbers: list[float] = []
        for group in self._groups:
            numbers += group.numbers(sight, frame)
        made = np.array(numbers, np.float32)
        np.maximum(made, self.low, out=made)
        return np.minimum(made, self.high, out=made)
