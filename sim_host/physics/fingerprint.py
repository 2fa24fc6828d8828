"""A fingerprint of the engine, the maths library and the arithmetic that a world is computed with."""

import importlib.metadata
import math
import struct
from functools import cache

import numpy as np

from sim_host.physics.bullet import pybullet


@cache
def _engine() -> str:
    """Version of the engine."""
    return f"pybullet {importlib.metadata.version('pybullet')}, api {pybullet.getAPIVersion()}"


def fingerprint() -> dict[str, str]:
    """What two machines must have in common to compute the same world: the engine, and results of maths and arrays.

    On a CPU without fused multiply-add, numpy rounds products of complex numbers twice.
    """
    answers = (math.sin(1e5), math.cos(2.5), math.exp(1.1), math.atan2(0.3, -0.7), math.pow(1.1, 7.3), math.log(3.3))
    products = np.array([0.3 + 0.7j, 1.1 - 2.3j]) * np.array([0.6 - 0.8j, 2.2 + 0.1j])
    return {"engine": _engine(), "libm": struct.pack("<6d", *answers).hex(), "numpy": products.tobytes().hex()}
