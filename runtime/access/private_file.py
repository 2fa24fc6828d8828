"""Files with secrets: readable by their owner alone, as ssh demands of a private key."""

import os
import stat
from pathlib import Path
from typing import BinaryIO

from schemas.errors import TouchlineError


def check_private(option: str, path: Path, file: BinaryIO) -> None:
    """Check that no other user may read or change an open file of this user.

    A file of another user, such as a secret that is mounted into a container, is that user's affair.

    Raises:
        TouchlineError: other users may.
    """
    found = os.fstat(file.fileno())
    mode = stat.S_IMODE(found.st_mode)
    if found.st_uid == os.getuid() and mode & (stat.S_IRWXG | stat.S_IRWXO):
        raise TouchlineError(f"{option} {path} may be read by others (mode {mode:o}); chmod 600 {path}")
