"""A host on the in-process bus: robots, recorders and strangers are seats beside it, and time passes by steps."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from schemas.bus.contract import Publisher
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
    """A small lockstep match at tick 0, everybody there."""
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


@pytest.fixture
def lose(monkeypatch: pytest.MonkeyPatch) -> Callable[[Publisher, set[int]], list[bytes]]:
    """Makes a writer lose some of its messages on the way, by number from 1; what it tried to send is in the list."""

    def spoil(writer: Publisher, lost: set[int]) -> list[bytes]:
        tried: list[bytes] = []
        send = writer.put_payload

        def put_payload(payload: bytes) -> None:
            tried.append(payload)
            if len(tried) not in lost:
                send(payload)

        monkeypatch.setattr(writer, "put_payload", put_payload)
        return tried

    return spoil
