"""The door to PyBullet: imports it without the greeting that it prints on stderr in every process."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

from sim_host.missing_engine import missing_engine_text

_STDERR = 2
_GREETING = b"pybullet build time"


@contextmanager
def _without_greeting() -> Iterator[None]:
    """Hold back what C code prints on stderr within the block; everything but the greeting is printed after it."""
    stderr = os.dup(_STDERR)
    with tempfile.TemporaryFile() as held:
        os.dup2(held.fileno(), _STDERR)
        try:
            yield
        finally:
            os.dup2(stderr, _STDERR)
            os.close(stderr)
            held.seek(0)
            for line in held:
                if not line.startswith(_GREETING):
                    os.write(_STDERR, line)


try:
    with _without_greeting():
        import pybullet as pybullet
except ModuleNotFoundError as error:
    if error.name != "pybullet":
        raise
    raise ModuleNotFoundError(missing_engine_text(), name="pybullet") from None
