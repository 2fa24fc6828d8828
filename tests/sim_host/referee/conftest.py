"""A rig for the referee: a world of points that does what the referee asks and nothing else."""

import pytest

from support.referee_rig import RefereeRig


@pytest.fixture(scope="session")
def new_rig() -> type[RefereeRig]:
    return RefereeRig


@pytest.fixture(params=["msl", "paper"])
def rig(request: pytest.FixtureRequest) -> RefereeRig:
    """A rig of each profile, with its own rule book."""
    return RefereeRig(request.param)
