"""The versions that `touchline --version` prints."""

import platform
from importlib.metadata import PackageNotFoundError, version

from schemas.wire.message import VERSION


def version_text() -> str:
    """One line: this library, the protocol, Python and PyBullet."""
    return (
        f"touchline {_installed('touchline')}, protocol {VERSION}, Python {platform.python_version()}, "
        f"PyBullet {_installed('pybullet')}"
    )


def _installed(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"
