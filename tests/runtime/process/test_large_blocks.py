import subprocess
import sys

import pytest

FREED = """
from runtime.process.large_blocks import return_large_blocks

return_large_blocks() if {wanted} else None
large, small = [], []
for _ in range(2000):
    large.append(b"x" * 60_000)
    small.append(bytes(2_000))  # stays, so that the heap cannot shrink
del large
with open("/proc/self/statm") as file:
    print(int(file.read().split()[1]) * 4096)
"""


def resident_mb(*, wanted: bool) -> float:
    """Memory of a process that has freed 120 MB of large blocks between small ones."""
    program = subprocess.run([sys.executable, "-c", FREED.format(wanted=wanted)], capture_output=True, check=True)
    return int(program.stdout) / 1e6


@pytest.mark.skipif(sys.platform != "linux", reason="glibc alone has the setting")
def test_large_blocks_that_are_freed_between_small_ones_go_back_to_the_system() -> None:
    assert resident_mb(wanted=False) - resident_mb(wanted=True) > 60.0


KEPT = """
from collections import deque

from runtime.process.large_blocks import mapped

kept = deque(maxlen=300)
small = []
for number in range(2000):
    kept.append(mapped(b"x" * 60_000))
    small.append(bytes(2_000))
kept.clear()
with open("/proc/self/statm") as file:
    print(int(file.read().split()[1]) * 4096)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_a_mapped_block_goes_back_to_the_system_when_it_is_dropped() -> None:
    program = subprocess.run([sys.executable, "-c", KEPT], capture_output=True, check=True)
    assert int(program.stdout) / 1e6 < 30.0
