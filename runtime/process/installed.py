"""Packages that are installed, and their versions."""

import importlib.util
from importlib.metadata import PackageNotFoundError, version

from schemas.errors import TouchlineError

NOT_INSTALLED = "not installed"


def installed_version(package: str) -> str:
    """The version of an installed package, or `NOT_INSTALLED`."""
    try:
        return version(package)
    except PackageNotFoundError:
        return NOT_INSTALLED


def need(what: str, extra: str, *modules: str) -> None:
    """Check that these modules are installed; `what` says who needs which package.

    Raises:
        TouchlineError: one is missing; the line ends with the command that installs the extra.
    """
    if any(importlib.util.find_spec(module) is None for module in modules):
        raise TouchlineError(f"{what}; pip install 'touchline[{extra}]'")
