"""A fingerprint of the referee: its program and its rule books."""

from functools import cache
from hashlib import blake2b
from importlib import resources
from importlib.resources.abc import Traversable


@cache
def referee_fingerprint() -> str:
    """A digest of the referee's program and of all rule books, hex."""
    content = blake2b(digest_size=8)
    for folder, suffix in ((resources.files("sim_host.referee"), ".py"), (resources.files("schemas"), ".toml")):
        root = folder if suffix == ".py" else folder / "rule_books"
        for path, text in sorted(_texts(root, "", suffix)):
            content.update(path.encode() + b"\0" + text + b"\0")
    return content.hexdigest()


def _texts(folder: Traversable, path: str, suffix: str) -> list[tuple[str, bytes]]:
    """Path and content of each file below a folder."""
    found = []
    for entry in folder.iterdir():
        if entry.is_dir():
            found += _texts(entry, f"{path}{entry.name}/", suffix)
        elif entry.name.endswith(suffix):
            found.append((path + entry.name, entry.read_bytes()))
    return found
