"""Control groups of version 2, on folders that look like the kernel's."""

from pathlib import Path

import pytest

from schemas.config.confinement import Limits
from touchline.launch.control_groups import control_groups, killed_for_memory


@pytest.fixture
def mount(tmp_path: Path) -> Path:
    """A hierarchy in which a user's session may make groups: this process is in `session/terminal`."""
    for group in ("", "session", "session/terminal"):
        folder = tmp_path / "cgroup" / group
        folder.mkdir()
        (folder / "cgroup.controllers").write_text("cpu memory pids\n")
        (folder / "cgroup.subtree_control").write_text("cpu memory pids\n" if group == "session" else "")
        (folder / "cgroup.procs").write_text("")
    (tmp_path / "own").write_text("3:pids:/elsewhere\n0::/session/terminal\n")
    return tmp_path / "cgroup"


def test_a_robot_gets_a_group_with_its_limits(mount: Path, tmp_path: Path) -> None:
    groups, reason = control_groups((mount,), tmp_path / "own")
    assert groups is not None and reason == ""
    group = groups.make("cyan1", Limits(memory=2.0, processes=64, cores=1.5))
    written = {name: (group / name).read_text() for name in ("memory.max", "memory.oom.group", "pids.max", "cpu.max")}
    assert written == {
        "memory.max": "2000000000",
        "memory.oom.group": "1",
        "pids.max": "64",
        "cpu.max": "150000 100000",
    }
    assert (group.parent / "cgroup.subtree_control").read_text() == "+memory +pids +cpu"


def test_groups_are_made_where_the_controllers_are_passed_on(mount: Path, tmp_path: Path) -> None:
    (mount / "session" / "terminal" / "cgroup.controllers").write_text("")
    groups, _ = control_groups((mount,), tmp_path / "own")
    assert groups is not None
    assert groups.make("cyan1", Limits()).parents[1] == mount / "session"


def test_a_hierarchy_without_controllers_is_named_with_what_it_lacks(mount: Path, tmp_path: Path) -> None:
    for folder in (mount, mount / "session", mount / "session" / "terminal"):
        (folder / "cgroup.controllers").write_text("hugetlb\n")
    groups, reason = control_groups((mount,), tmp_path / "own")
    assert groups is None
    assert reason == f"{mount} lacks the controllers memory, pids, cpu"


def test_a_system_without_version_2_is_named(tmp_path: Path) -> None:
    (tmp_path / "own").write_text("3:pids:/elsewhere\n")
    assert control_groups((tmp_path,), tmp_path / "own") == (None, "the system has no control groups of version 2")


def test_processes_that_the_kernel_ended_for_their_memory_are_counted(tmp_path: Path) -> None:
    assert killed_for_memory(tmp_path) == 0
    (tmp_path / "memory.events").write_text("low 0\nhigh 0\nmax 12\noom 3\noom_kill 2\n")
    assert killed_for_memory(tmp_path) == 2
