"""A host on the in-process bus with its clients; time passes in steps."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from schemas.config.match_config import MatchConfig
from support.host_rig import TEAMS, HostRig


@pytest.fixture
def rig_of() -> Iterator[Callable[..., HostRig]]:
    """Makes a host of a small match; the words are those of the match file."""
    made: list[HostRig] = []

    def make(**words: Any) -> HostRig:
        made.append(HostRig(MatchConfig.model_validate({"seed": 7, "teams": TEAMS, **words})))
        return made[-1]

    yield make
    for rig in made:
        rig.host.simulation.close()


@pytest.fixture
def rig(rig_of: Callable[..., HostRig]) -> HostRig:
    """A small lockstep match at tick 0 with all agents."""
    rig = rig_of()
    rig.join_all()
    rig.begin()
    return rig


@pytest.fixture
def realtime_rig(rig_of: Callable[..., HostRig]) -> HostRig:
    """The same in real time."""
    rig = rig_of(pace="realtime")
    rig.join_all()
    rig.begin()
    return rig
