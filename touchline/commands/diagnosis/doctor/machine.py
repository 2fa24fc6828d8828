"""Examines this machine: Python, packages, cores, disk, limits, and the matches that run on it."""

import importlib.util
import os
import platform
import resource
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from runtime.bus.announcement import Announcement, running_hosts
from sim_host.missing_engine import missing_engine_text
from touchline.commands.diagnosis.doctor.finding import Finding, Status

_EXTRAS: Mapping[str, tuple[tuple[str, ...], str]] = {
    "coach": (("starlette", "uvicorn", "websockets"), "the page of --web"),
    "viz": (("foxglove",), "live viewers"),
    "ros2": (("rosbags", "xxhash"), "nodes and bags of ROS 2"),
    "tls": (("trustme",), "making certificates"),
}
"""Extra → its packages as they are imported, and what needs them."""
_LITTLE_DISK, _NO_DISK = 1e9, 5e7
"""Free bytes below which recordings may not fit, and below which none does."""
_FEW_FILES = 1024
"""Open files that a host with many clients and its recordings may need."""


@dataclass(frozen=True)
class MachineFacts:
    """What is examined on a machine."""

    python: str
    packages: frozenset[str]
    """Those of the packages in question that are installed."""
    cores: int
    folder: Path
    """Where recordings are written."""
    free_bytes: int
    """Free bytes in that folder."""
    open_files: int
    """Most files and connections that a process may have open."""
    matches: tuple[Announcement, ...]
    """The matches of this user that run."""

    @classmethod
    def of_this_machine(cls) -> Self:
        """The facts of this machine, with recordings in the current directory."""
        wanted = {"pybullet", *(package for packages, _ in _EXTRAS.values() for package in packages)}
        folder = Path.cwd() / "runs"
        existing = folder if folder.is_dir() else Path.cwd()
        return cls(
            python=platform.python_version(),
            packages=frozenset(package for package in wanted if importlib.util.find_spec(package) is not None),
            cores=len(os.sched_getaffinity(0)),
            folder=folder,
            free_bytes=shutil.disk_usage(existing).free,
            open_files=resource.getrlimit(resource.RLIMIT_NOFILE)[0],
            matches=tuple(running_hosts()),
        )


def examine_machine(facts: MachineFacts) -> Iterator[Finding]:
    """The findings on a machine; none of them is needed by a robot alone, so that few fail."""
    yield Finding("python", Status.OK, f"Python {facts.python}")
    yield _engine(facts)
    yield from _extras(facts)
    yield _cores(facts)
    yield _disk(facts)
    yield _open_files(facts)
    for host in facts.matches:
        text = f'"{host.match}" on {host.endpoint}, process {host.pid}, started in {host.folder}'
        yield Finding("match", Status.OK, text)


def _engine(facts: MachineFacts) -> Finding:
    if "pybullet" in facts.packages:
        return Finding("pybullet", Status.OK, "installed: this machine can host a match")
    return Finding(
        "pybullet",
        Status.NOTE,
        "not installed: this machine can run robots, coaches and recorders, but no host",
        f"for a host: {missing_engine_text()}",
    )


def _extras(facts: MachineFacts) -> Iterator[Finding]:
    for extra, (packages, what) in _EXTRAS.items():
        missing = [package for package in packages if package not in facts.packages]
        if missing:
            yield Finding(
                extra,
                Status.NOTE,
                f"{', '.join(missing)} not installed; for {what}",
                f"pip install 'touchline[{extra}]'",
            )
        else:
            yield Finding(extra, Status.OK, f"installed: {what}")


def _cores(facts: MachineFacts) -> Finding:
    if facts.cores > 1:
        return Finding("cores", Status.OK, f"{facts.cores} cores")
    return Finding(
        "cores",
        Status.WARNING,
        "1 core: host and robots take turns",
        "run a match in lockstep, or the robots on another machine",
    )


def _disk(facts: MachineFacts) -> Finding:
    text = f"{facts.free_bytes / 1e9:.1f} GB free in {facts.folder}"
    if facts.free_bytes < _NO_DISK:
        return Finding("disk", Status.FAILED, text, "free some space, or record elsewhere: --record /other/disk.mcap")
    if facts.free_bytes < _LITTLE_DISK:
        return Finding("disk", Status.WARNING, text, "a match of 10 min takes about 0.2 GB; free some space")
    return Finding("disk", Status.OK, text)


def _open_files(facts: MachineFacts) -> Finding:
    if facts.open_files == resource.RLIM_INFINITY:
        return Finding("limits", Status.OK, "any number of open files in a process")
    if facts.open_files >= _FEW_FILES:
        return Finding("limits", Status.OK, f"{facts.open_files} open files in a process")
    return Finding(
        "limits",
        Status.WARNING,
        f"{facts.open_files} open files in a process: a host has room for few clients",
        f"ulimit -n {4 * _FEW_FILES}",
    )
