"""Programs that take turns: one that is woken waits for a core instead of pushing aside whoever has it.

In lockstep everybody waits for somebody: a sight wakes a robot while another still thinks, a command wakes the host. By
its ordinary policy the kernel runs the one that is woken at once; both then work with caches that the other has filled.
Ten robots on two cores play about a sixth faster when each finishes its thought (Linux, SCHED_BATCH).
"""

import os
import sys
from contextlib import suppress
from pathlib import Path


def use_batch_scheduling(enabled: bool = True) -> None:
    """Let this process take turns, or be run at once as others are: its threads, and those that they start.

    Where the kernel knows no such policy, or grants none, it stays as it is: nothing but speed depends on it.
    """
    if sys.platform != "linux":
        return
    policy = os.SCHED_BATCH if enabled else os.SCHED_OTHER
    for thread in Path("/proc/self/task").iterdir():
        with suppress(OSError):  # it has ended meanwhile, or a sandbox forbids it
            os.sched_setscheduler(int(thread.name), policy, os.sched_param(0))
