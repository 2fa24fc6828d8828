"""Presets of perception noise; `profile` stands for the numbers of the profile."""

from dataclasses import replace

from schemas.config.profile import load_profile
from schemas.config.sections import Sensing
from schemas.errors import TouchlineError, did_you_mean

PERFECT = Sensing(
    own_position=0.0,
    own_heading=0.0,
    own_velocity=0.0,
    own_turn_rate=0.0,
    drift_position=0.0,
    drift_heading=0.0,
    drift_time=10.0,
    ball_position=0.0,
    ball_velocity=0.0,
    ball_velocity_growth=0.0,
    obstacle_position=0.0,
    range_noise=0.0,
    bearing_noise=0.0,
    noise_rate=1.0,
    ball_range=1000.0,
    obstacle_range=1000.0,
    ball_dropout=0.0,
    obstacle_dropout=0.0,
    occlusion="nothing",
    camera_rate=1000.0,
    latency=0.0,
)
"""The complete truth, without noise or latency."""

SIMATCH = replace(
    PERFECT,
    own_position=0.1,
    own_velocity=0.1,
    ball_position=0.1,
    ball_velocity=0.1,
    obstacle_position=0.1,
    noise_rate=0.01,
)
"""simatch's global_config.yaml: scale 0.10 m and m/s at a rate of 0.01, that is, one reading in a hundred.

As in its plugin, x, y, vx and vy have noise, also of the robot itself; heading and turn rate have none.
"""

PRESETS = ("profile", "perfect", "paper", "simatch")
"""`paper` has the noise of the paper's plugin, a standard deviation of 0.0194 on positions, velocities and turn rate,
and no limits of range."""


def sensing_of(preset: str, own: Sensing) -> Sensing:
    """The perception of a preset, in a match whose profile has `own`.

    Raises:
        TouchlineError: there is no such preset.
    """
    if preset == "paper":
        return load_profile("paper").sensing
    known = {"profile": own, "perfect": PERFECT, "simatch": SIMATCH}
    if preset not in known:
        raise TouchlineError(f'noise.preset is "{preset}"; {did_you_mean(preset, PRESETS)}')
    return known[preset]
