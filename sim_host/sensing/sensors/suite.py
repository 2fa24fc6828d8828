"""All sensors of the table that the robots of a match carry; most matches have none."""

from typing import Any

from msgspec.structs import replace

from schemas.config.profile import Profile
from schemas.config.sensors.table import Reading
from schemas.messages.percept import DIGITS
from sim_host.sensing.random_streams import RandomStreams
from sim_host.sensing.sensors.carried import Carried, ComputedSensor
from sim_host.sensing.sensors.table import COMPUTED
from sim_host.sensing.shutter import Shutter
from sim_host.snapshot import Roster, Snapshot

Readings = dict[str, Reading]
"""Sensor → its reading, of one robot."""


class SensorSuite:
    """Reads the sensors of all robots; between two readings a robot has the newest one, with its age."""

    def __init__(self, profile: Profile, roster: Roster, streams: RandomStreams) -> None:
        self._tick_s = profile.time.tick
        self._names = roster.names
        robots: dict[tuple[str, Any], list[int]] = {}
        for place, model in enumerate(roster.models):
            for name, numbers in profile.sensors_of(model.type).items():
                robots.setdefault((name, numbers), []).append(place)
        self._carried = [
            Carried(
                name=name,
                numbers=numbers,
                robots=tuple(places),
                roster=roster,
                pitch=profile.field,
                ball_radius=profile.ball.radius,
                tick=profile.time.tick,
                shutter=Shutter.at_rate(numbers.rate, profile.time.tick),
                streams=streams,
            )
            for (name, numbers), places in robots.items()
        ]
        self._computed: list[ComputedSensor] = [COMPUTED[one.numbers.kind](one) for one in self._carried]
        self._newest: list[Readings] = [{} for _ in self._names]
        self.fresh: dict[str, Readings] = {}
        """Robot → the readings taken in the newest tick."""

    def at(self, snapshot: Snapshot) -> list[Readings]:
        """The newest readings of all robots, in the order of the roster, valid until the next call.

        A robot that joins has no reading before the first one that is due: the tick alone determines what is read.
        """
        if not self._carried:
            return self._newest
        self.fresh = {}
        for carried, computed in zip(self._carried, self._computed, strict=True):
            self._update(carried, computed, snapshot)
        return self._newest

    def _update(self, carried: Carried, computed: ComputedSensor, snapshot: Snapshot) -> None:
        """Read a sensor if a reading is due; otherwise its readings grow older."""
        tick, name = snapshot.tick, carried.name
        number = carried.shutter.number(tick)
        taken = carried.shutter.tick_of(number)
        if tick == taken:
            readings = computed.read(snapshot, number)
            for place, reading in zip(carried.robots, readings, strict=True):
                self._newest[place][name] = reading
                self.fresh.setdefault(self._names[place], {})[name] = reading
            return
        age = round((tick - taken) * self._tick_s, DIGITS)
        for place in carried.robots:
            held: Any = self._newest[place].get(name)
            if held is not None:
                self._newest[place][name] = replace(held, age=age)
