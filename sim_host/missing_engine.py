"""The message for a machine without PyBullet."""

import sys

_WITH_WHEELS = (3, 11)
"""The Python for which the pinned PyBullet has binary wheels; elsewhere pip compiles it for half an hour."""


def missing_engine_text(python: tuple[int, int] = sys.version_info[:2]) -> str:
    """What is missing, with the command that installs it for this version of Python."""
    install = "pip install 'touchline[sim]'"
    if python == _WITH_WHEELS:
        return f"the simulation needs PyBullet, which is not installed; {install}"
    this, other = (".".join(map(str, version)) for version in (python, _WITH_WHEELS))
    return (
        f"the simulation needs PyBullet, which has no binary package for Python {this}; use Python {other}: "
        f"uv venv --python {other}, and in that environment {install}"
    )
