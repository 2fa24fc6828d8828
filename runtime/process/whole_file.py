"""Files and folders that have their name when they are complete, and never appear if writing them fails."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def written_whole(path: Path, *, private: bool = False, replace: bool = True) -> Iterator[Path]:
    """The path of a draft, to be written in the block, which is moved to `path` at its end.

    A `private` draft is an empty file that only its owner may read. Without `replace`, a file that is there is kept.

    Raises:
        FileExistsError: there is such a file already, which must not be replaced.
        OSError: the draft cannot be written or moved.
    """
    folder = Path(tempfile.mkdtemp(dir=path.parent, prefix=f".{path.name}-"))
    draft = folder / path.name
    try:
        if private:
            draft.touch(mode=0o600)
        yield draft
        if replace:
            draft.replace(path)
        else:
            os.link(draft, path)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
