"""The versions that `touchline --version` prints."""

import platform

from runtime.process.installed import installed_version
from schemas.wire.message import VERSION


def version_text() -> str:
    """One line: this library, the protocol, Python and PyBullet."""
    return (
        f"touchline {installed_version('touchline')}, protocol {VERSION}, Python {platform.python_version()}, "
        f"PyBullet {installed_version('pybullet')}"
    )
