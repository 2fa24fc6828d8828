"""A fingerprint of the referee's program, without the numbers of its rule book, which a recording has."""

from functools import cache
from hashlib import blake2b
from importlib import resources
from importlib.resources.abc import Traversable


@cache
def referee_fingerprint() -> str:
    """A digest of the referee's program, hex."""
    content = blake2b(digest_size=8)
    for path, text in sorted(_texts(resources.files("sim_host.soccer.referee"), "")):
        content.update(path.encode() + b"\0" + text + b"\0")
    return content.hexdigest()


def _texts(folder: Traversable, path: str) -> list[tuple[str, bytes]]:
    """Path and content of each module below a folder."""
    found = []
    for entry in folder.iterdir():
        if entry.is_dir():
            found += _texts(entry, f"{path}{entry.name}/")
        elif entry.name.endswith(".py"):
            found.append((path + entry.name, entry.read_bytes()))
    return found
