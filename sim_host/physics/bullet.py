"""The door to PyBullet: imports it without the greeting that it prints on stderr in every process; keeps a client."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

from sim_host.missing_engine import missing_engine_text

_STDERR = 2
_GREETING = b"pybullet build time"
_idle: list[int] = []
"""A client that was released; its 35 MB take longer to get than the bodies of a world to make."""


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


def take_client() -> int:
    """A client of PyBullet, in the memory of one that was released if there is one: its world is to be reset."""
    try:
        return _idle.pop()
    except IndexError:
        client: int = pybullet.connect(pybullet.DIRECT)
        return client


def release_client(client: int) -> None:
    """Keep a client for the next who takes one; of several, the others free their memory."""
    if _idle:
        pybullet.disconnect(client)
    else:
        _idle.append(client)
