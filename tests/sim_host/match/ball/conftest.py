"""A world of four robots and a ball that tests set down, push and look at."""

from dataclasses import replace

import pytest

from schemas.config.profile import load_profile
from support.world_rig import NAMES, WorldRig, tell


@pytest.fixture
def build():
    """Builds rigs, of a profile by name with changed numbers: section → field → value."""
    rigs = []

    def make(name="msl", order=NAMES, **changes):
        profile = load_profile(name)
        sections = {section: replace(getattr(profile, section), **numbers) for section, numbers in changes.items()}
        rigs.append(WorldRig(replace(profile, **sections), order))
        return rigs[-1]

    yield make
    for rig in rigs:
        rig.world.close()


@pytest.fixture(params=["msl", "paper"])
def rig(request, build):
    """Either profile as it ships."""
    return build(request.param)


@pytest.fixture(name="tell")
def tell_fixture():
    return tell
