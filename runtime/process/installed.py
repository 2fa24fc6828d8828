"""The versions of installed packages."""

from importlib.metadata import PackageNotFoundError, version

NOT_INSTALLED = "not installed"


def installed_version(package: str) -> str:
    """The version of an installed package, or `NOT_INSTALLED`."""
    try:
        return version(package)
    except PackageNotFoundError:
        return NOT_INSTALLED
