"""Worlds of two a side, of either profile or with changed numbers."""

from dataclasses import replace

import pytest

from schemas.config.profile import load_profile
from support.world_rig import WorldRig, tell, two_a_side


@pytest.fixture
def build():
    """Builds rigs, of a profile by name with changed numbers: section → field → value; `order` shuffles the roster.

    `robots` changes numbers of single robots: name → section → field → value.
    """
    rigs = []

    def make(name="msl", order=None, robots=None, **changes):
        profile = load_profile(name)
        sections = {section: replace(getattr(profile, section), **numbers) for section, numbers in changes.items()}
        profile = replace(profile, **sections)
        roster = two_a_side(profile)
        if order is not None:
            sides = dict(zip(roster.names, roster.sides, strict=True))
            roster = replace(roster, names=tuple(order), sides=tuple(sides[robot] for robot in order))
        models = list(roster.models)
        for robot, numbers in (robots or {}).items():
            place = roster.names.index(robot)
            for section, values in numbers.items():
                part = replace(getattr(models[place], section), **values)
                models[place] = replace(models[place], **{section: part})
        roster = replace(roster, models=tuple(models))
        rigs.append(WorldRig(profile, roster))
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
