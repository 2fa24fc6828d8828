"""Presets of perception."""

from dataclasses import fields

import pytest

from schemas.config.noise import PRESETS, sensing_of
from schemas.config.profile import load_profile
from schemas.config.quantity import Choice, meanings
from schemas.config.sections import Sensing
from schemas.errors import TouchlineError

MSL = load_profile("msl").sensing


@pytest.mark.parametrize("preset", PRESETS)
def test_every_number_of_a_preset_is_one_that_a_profile_may_have(preset: str) -> None:
    sensing = sensing_of(preset, MSL)
    for name, meaning in meanings(Sensing).items():
        value = getattr(sensing, name)
        assert value in meaning.options if isinstance(meaning, Choice) else meaning.low <= value <= meaning.high


def test_the_preset_profile_has_the_numbers_of_the_profile_and_perfect_has_no_noise() -> None:
    assert sensing_of("profile", MSL) is MSL
    perfect = sensing_of("perfect", MSL)
    noises = [
        field.name
        for field in fields(Sensing)
        if field.name.startswith(("own_", "ball_pos", "ball_vel", "obstacle_pos"))
    ]
    assert all(getattr(perfect, name) == 0.0 for name in (*noises, "drift_position", "drift_heading", "latency"))


def test_a_preset_that_is_not_known_is_named_with_the_nearest() -> None:
    with pytest.raises(TouchlineError, match='did you mean "simatch"'):
        sensing_of("simmatch", MSL)
