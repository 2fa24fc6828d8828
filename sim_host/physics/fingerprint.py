"""A fingerprint of the engine and the maths library that a world is computed with."""

import importlib.metadata
import math
import struct

from sim_host.physics.bullet import pybullet


def fingerprint() -> dict[str, str]:
    """What two machines must have in common to compute the same world: the engine, and results of the maths library."""
    answers = (math.sin(1e5), math.cos(2.5), math.exp(1.1), math.atan2(0.3, -0.7), math.pow(1.1, 7.3), math.log(3.3))
    version = importlib.metadata.version("pybullet")
    return {"engine": f"pybullet {version}, api {pybullet.getAPIVersion()}", "libm": struct.pack("<6d", *answers).hex()}
