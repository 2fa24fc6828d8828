"""Control groups of Linux, version 2: the kernel limits memory, processes and CPU of a robot as a whole.

They are used where a folder of them can be written, as in a user's session under systemd or in a container that was
given one. Elsewhere `touchline.launch.usage_watch` limits memory and processes, and nothing limits the cores.
"""

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from schemas.config.confinement import Limits
from schemas.errors import TouchlineError

MOUNTS = (Path("/sys/fs/cgroup"), Path("/sys/fs/cgroup/unified"))
"""Where Linux mounts version 2: alone, or beside version 1."""
_OWN_GROUP = Path("/proc/self/cgroup")
_CONTROLLERS = ("memory", "pids", "cpu")
_PERIOD_US = 100_000
"""Period of cpu.max, in us."""


class ControlGroups:
    """The control groups of one match, each of a robot."""

    def __init__(self, above: Path) -> None:
        """`above` is the group that they are made in; its controllers are enabled.

        Raises:
            OSError: the group cannot be written.
        """
        self._folder = above / f"touchline-{os.getpid()}"
        self._folder.mkdir()
        try:
            self._enable()
        except OSError:
            self._folder.rmdir()
            raise

    def _enable(self) -> None:
        (self._folder / "cgroup.subtree_control").write_text(" ".join(f"+{name}" for name in _CONTROLLERS))

    def make(self, robot: str, limits: Limits) -> Path:
        """The group of a robot, with its limits; one that is there is used again.

        Raises:
            TouchlineError: a limit cannot be written.
        """
        group = self._folder / robot
        values = {
            "memory.max": f"{round(limits.memory * 1e9)}",
            "memory.swap.max": "0",
            "memory.oom.group": "1",
            "pids.max": f"{limits.processes}",
            "cpu.max": f"{round(limits.cores * _PERIOD_US)} {_PERIOD_US}",
        }
        try:
            group.mkdir(exist_ok=True)
            for name, value in values.items():
                with suppress(FileNotFoundError):  # a kernel without swap has no limit of it
                    (group / name).write_text(value)
        except OSError as error:
            raise TouchlineError(f"{error.filename}: {error.strerror}; the limits of {robot} stand there") from None
        return group

    def close(self) -> None:
        """Remove the groups; those with processes that are still ending stay."""
        for group in (*self._folder.iterdir(), self._folder):
            if group.is_dir():
                with suppress(OSError):
                    group.rmdir()


def killed_for_memory(group: Path) -> int:
    """The number of processes of a group that the kernel has ended because of its memory."""
    try:
        counts = dict(line.split() for line in (group / "memory.events").read_text().splitlines())
    except OSError:
        return 0
    return int(counts.get("oom_kill", 0))


def end_group(group: Path) -> None:
    """End all processes of a group, those included that have left the process group of their robot."""
    with suppress(OSError):
        (group / "cgroup.kill").write_text("1")


def control_groups(mounts: tuple[Path, ...] = MOUNTS, own: Path = _OWN_GROUP) -> tuple[ControlGroups | None, str]:
    """The control groups that this process may make; None with the reason where it may not."""
    reason = "the system has no control groups of version 2"
    for above in _groups_above(mounts, own):
        try:
            offered = (above / "cgroup.controllers").read_text().split()
            missing = [name for name in _CONTROLLERS if name not in offered]
            if missing:
                reason = f"{above} lacks the controllers {', '.join(missing)}"
                continue
            if not os.access(above / "cgroup.procs", os.W_OK):  # who moves a process has to write there, too
                reason = f"{above / 'cgroup.procs'} cannot be written"
                continue
            enabled = (above / "cgroup.subtree_control").read_text().split()
            to_enable = [f"+{name}" for name in _CONTROLLERS if name not in enabled]
            if to_enable:
                (above / "cgroup.subtree_control").write_text(" ".join(to_enable))
            return ControlGroups(above), ""
        except OSError as error:
            reason = f"{error.filename}: {error.strerror}"
    return None, reason


def _groups_above(mounts: tuple[Path, ...], own: Path) -> Iterator[Path]:
    """The groups from that of this process upward, in the first mount that there is."""
    mount = next((one for one in mounts if (one / "cgroup.controllers").exists()), None)
    try:
        line = next((line for line in own.read_text().splitlines() if line.startswith("0::")), None)
    except OSError:
        return
    if mount is None or line is None:
        return
    group = mount / line.removeprefix("0::").strip().lstrip("/")
    for above in (group, *group.parents):
        if above.is_relative_to(mount):
            yield above
