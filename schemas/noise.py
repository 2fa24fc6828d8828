"""Named amounts of noise on what robots perceive; `profile` stands for the profile's own numbers."""

from dataclasses import fields

from schemas.errors import TouchlineError, did_you_mean
from schemas.profile import Sensing, load_profile

PRESETS = ("profile", "perfect", "paper")
"""`perfect` sees the truth; `paper` has sigma 0.0194 on positions, velocities and turn rate, as the paper's plugin."""


def sensing_of(preset: str, own: Sensing) -> Sensing:
    """The noise that a preset stands for, in a match whose profile has `own`."""
    if preset == "profile":
        return own
    if preset == "perfect":
        return Sensing(**{field.name: 0.0 for field in fields(Sensing)})
    if preset == "paper":
        return load_profile("paper").sensing
    raise TouchlineError(f'noise.preset is "{preset}"; {did_you_mean(preset, PRESETS)}')
