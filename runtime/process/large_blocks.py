"""Large blocks of memory: each goes back to the system as soon as it is free.

A host and a recorder hold record batches of about 60 kB for a while. By default glibc keeps the memory of freed blocks
of that size, in pieces that later ones seldom fit: a host grew by 1 to 2.5 MB a minute although it held no more.

A mapping costs a call of the system and a page fault for each 4 kB. The host therefore maps what it keeps, and nothing
else: numpy's arrays, which live for microseconds, would cost it a third of its tick with 22 robots.
"""

import ctypes
import mmap
import sys
from contextlib import suppress

_MMAP_THRESHOLD = -3
"""`M_MMAP_THRESHOLD` of glibc's malloc.h."""
_LARGE_BYTES = 32_768


def mapped(data: bytes) -> memoryview:
    """A copy of data, not empty, in a mapping of its own."""
    if sys.platform == "win32":
        block = mmap.mmap(-1, len(data))
    else:  # half the time of a shared mapping, the default
        block = mmap.mmap(-1, len(data), mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    block.write(data)
    return memoryview(block)


def return_large_blocks() -> None:
    """Map each block of this process from now on that is larger than 32 KiB; does nothing without glibc."""
    if sys.platform == "linux":
        with suppress(AttributeError):  # another C library
            ctypes.CDLL(None).mallopt(_MMAP_THRESHOLD, _LARGE_BYTES)
