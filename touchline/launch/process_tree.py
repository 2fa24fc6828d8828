"""The processes that a process has started, as Linux lists them under /proc, and what they use."""

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

PROC = Path("/proc")
_PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")
_TICKS_PER_S = os.sysconf("SC_CLK_TCK")


class Usage(NamedTuple):
    """What a process uses, or several together."""

    memory: int
    """Resident memory in bytes; pages that processes share count for each."""
    threads: int
    cpu_s: float
    """CPU time in s, with that of children that have ended and were waited for."""


class ProcessLine(NamedTuple):
    """Fields of proc(5)'s `stat`."""

    state: str
    parent: int
    usage: Usage


def process_line(pid: int) -> ProcessLine | None:
    """The state of a process; None if there is none."""
    try:
        fields = (PROC / str(pid) / "stat").read_bytes().rpartition(b")")[2].split()
    except OSError:
        return None
    cpu = sum(map(int, fields[11:15])) / _TICKS_PER_S
    return ProcessLine(fields[0].decode(), int(fields[1]), Usage(int(fields[21]) * _PAGE_BYTES, int(fields[17]), cpu))


def children_of(pid: int) -> list[int]:
    """The children of a process, zombies included; none where the kernel does not list them."""
    found: list[int] = []
    with suppress(OSError):  # the process has ended
        for thread in (PROC / str(pid) / "task").iterdir():
            with suppress(OSError):
                found += map(int, (thread / "children").read_bytes().split())
    return found


def tree_of(pid: int) -> list[int]:
    """A process and all its descendants, parents first."""
    found = [pid]
    for one in found:
        found += children_of(one)
    return found


def tasks_of_user(user: int) -> int:
    """Processes and threads of a user, as the kernel counts them for RLIMIT_NPROC."""
    return sum(line.usage.threads for line in map(process_line, _pids_of_user(user)) if line is not None)


def _pids_of_user(user: int) -> Iterator[int]:
    for folder in PROC.glob("[0-9]*"):
        with suppress(OSError):  # it has ended
            if folder.stat().st_uid == user:
                yield int(folder.name)


def usage_of(pids: list[int]) -> Usage:
    """What these processes use together."""
    lines = [line.usage for line in map(process_line, pids) if line is not None]
    return Usage(sum(one.memory for one in lines), sum(one.threads for one in lines), sum(one.cpu_s for one in lines))


def proportional_memory(pids: list[int]) -> int:
    """Memory of these processes in bytes; of a page that several share, each has its part. Costly to find out."""
    total = 0
    for pid in pids:
        with suppress(OSError):  # it has ended
            lines = (PROC / str(pid) / "smaps_rollup").read_text().splitlines()
            total += sum(int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:"))
    return total
