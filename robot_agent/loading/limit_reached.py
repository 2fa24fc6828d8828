"""Names the limit of its process that made a brain's code fail, with the remedy."""

import errno
import resource

from schemas.config.confinement import Limits

_OF_ERRNO = {
    errno.EMFILE: (resource.RLIMIT_NOFILE, "open_files", 1),
    errno.EFBIG: (resource.RLIMIT_FSIZE, "file_size", 1e6),
}
_OF_MEMORY = (resource.RLIMIT_DATA, "memory", 1e9)
"""Resource, the limit of a match file that sets it, and the unit of that."""


def limit_reached(error: BaseException) -> str:
    """What the process did that exceeded a limit, with the remedy; empty if no limit made it fail."""
    if isinstance(error, MemoryError):
        number, limit, unit = _OF_MEMORY
    elif isinstance(error, OSError) and error.errno in _OF_ERRNO:
        number, limit, unit = _OF_ERRNO[error.errno]
    else:
        return ""
    soft, _ = resource.getrlimit(number)
    if soft == resource.RLIM_INFINITY:
        return ""
    return Limits().model_copy(update={limit: soft / unit if unit != 1 else soft}).breach(limit)
