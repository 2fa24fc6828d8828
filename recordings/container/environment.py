"""What a recording notes about the machine that made it: versions, and a fingerprint of its maths library."""

import hashlib
import math
import platform
import struct

from runtime.process.installed import NOT_INSTALLED, installed_version
from schemas.wire.message import VERSION

_PACKAGES = ("touchline", "mcap", "numpy", "pydantic", "eclipse-zenoh", "pybullet")
_ARGUMENTS = tuple(0.1 + 0.37 * step for step in range(200))
_FUNCTIONS = (math.sin, math.cos, math.tan, math.exp, math.log, math.atan, math.sqrt, math.tanh)


def library() -> str:
    """Name and version of the program that writes the file: `touchline/0.1.0`."""
    return f"touchline/{installed_version('touchline')}"


def versions() -> dict[str, str]:
    """Versions of Python, platform and packages; a package that is not installed is left out."""
    packages = {package: version for package in _PACKAGES if (version := installed_version(package)) != NOT_INSTALLED}
    machine = {"platform": platform.platform(), "machine": platform.machine()}
    return {"contract": VERSION, "python": platform.python_version(), **packages, **machine}


def libm_fingerprint() -> str:
    """A hash over results of the machine's mathematical functions.

    Machines with different fingerprints may simulate the same match differently in the last bits.
    """
    results = [function(argument) for function in _FUNCTIONS for argument in _ARGUMENTS]
    results += [math.atan2(argument, 1.7) + math.pow(argument, 1.3) for argument in _ARGUMENTS]
    return hashlib.blake2b(struct.pack(f"<{len(results)}d", *results), digest_size=8).hexdigest()
