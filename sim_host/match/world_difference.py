"""Compares a recorded world with its resimulation, field by field."""

from collections.abc import Mapping
from typing import NamedTuple

from sim_host.match.world_fields import Fields
from sim_host.snapshot import BALL


class Difference(NamedTuple):
    """A field of a body that differs from its recorded value; positions in m, headings in rad, speeds in m/s, rad/s."""

    body: str
    """A robot, `ball`, an obstacle, or `world` for fields that belong to no body."""
    field: str
    recorded: object
    simulated: object

    @property
    def by(self) -> float | None:
        """The absolute difference; None unless both values are numbers."""
        pair = self.recorded, self.simulated
        if any(isinstance(one, bool) or not isinstance(one, int | float) for one in pair):
            return None
        return abs(float(self.simulated) - float(self.recorded))  # type: ignore[arg-type]


def differences(recorded: Mapping[str, object], simulated: Fields) -> list[Difference]:
    """Every field in which a recorded world differs from its resimulation: robots, obstacles, ball, then the rest."""
    found: list[Difference] = []
    for group in ("robots", "obstacles"):
        theirs, ours = _table(recorded.get(group)), simulated.get(group, {})
        for name in dict.fromkeys([*ours, *theirs]):
            found += _body_differences(name, _table(theirs.get(name)), ours.get(name, {}))
    found += _body_differences(BALL, _table(recorded.get("ball")), simulated["ball"] or {})
    own = {key: simulated.get(key, _ABSENT.get(key)) for key in _OWN}
    own |= {key: simulated[key] for key in _OFFICIATED if key in simulated}
    found += _body_differences("world", recorded, own)
    return found + _reading_differences(_table(recorded.get("sensors")), simulated.get("sensors"))


def _reading_differences(recorded: Mapping[str, object], simulated: Fields | None) -> list[Difference]:
    """Readings that differ, of each robot; none where the sensors were not simulated."""
    if simulated is None or recorded == simulated:
        return []
    found = []
    for name in dict.fromkeys([*simulated, *recorded]):
        theirs, ours = _table(recorded.get(name)), simulated.get(name, {})
        pairs = ((sensor, theirs.get(sensor), ours.get(sensor)) for sensor in dict.fromkeys([*ours, *theirs]))
        found += [Difference(name, f"sensors.{sensor}", one, other) for sensor, one, other in pairs if one != other]
    return found


_OWN = ("tick", "time", "possession", "touches", "level", "kicked")
_OFFICIATED = ("clock", "episode")
"""Fields of the world that referee and operator determine; compared where the referee is simulated, too."""
_ABSENT: dict[str, object] = {"touches": [], "level": []}
"""Value of a field of the world that is left out of a message; None for other fields."""


def _table(value: object) -> Mapping[str, object]:
    return value if isinstance(value, Mapping) else {}


def _body_differences(name: str, recorded: Mapping[str, object], simulated: Mapping[str, object]) -> list[Difference]:
    if simulated.items() <= recorded.items():
        return []
    pairs = ((key, recorded.get(key, _ABSENT.get(key)), ours) for key, ours in simulated.items())
    return [Difference(name, key, theirs, ours) for key, theirs, ours in pairs if theirs != ours]
