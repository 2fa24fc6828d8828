"""A rig for the referee: a world of points that does what the referee asks and nothing else."""

import copy

import pytest

from schemas.soccer.game import GameStage
from support.referee_rig import RefereeRig


@pytest.fixture(scope="session")
def new_rig() -> type[RefereeRig]:
    return RefereeRig


@pytest.fixture(params=["msl", "paper"])
def rig(request: pytest.FixtureRequest) -> RefereeRig:
    """A rig of each profile, with its own rule book."""
    return RefereeRig(request.param)


@pytest.fixture(scope="session")
def level_after_extra_time() -> RefereeRig:
    """A match of the league that needs a winner: the first penalty of its shoot-out is signalled."""
    rig = RefereeRig("msl", winner=True, duration=8.0)
    return rig.until(lambda state: state.stage is GameStage.SHOOT_OUT, 600.0)


@pytest.fixture
def penalties(level_after_extra_time: RefereeRig) -> RefereeRig:
    return copy.deepcopy(level_after_extra_time)
