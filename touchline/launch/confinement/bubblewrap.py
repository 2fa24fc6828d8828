"""The view of the machine that a robot has in bubblewrap: `bwrap` and its arguments.

Programs and libraries are there and read-only, the robot's working folder is its own, and nothing else of the users'
files is. Process ids are its own, so that it can signal no other program. The network is shared: robots meet the host
on loopback.
"""

import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from robot_agent.process.timing import PROGRAM_S
from schemas.errors import TouchlineError

NOBODY = 65534
"""Id of the user and the group that robots have in place of root. Root in bubblewrap could leave it, and what belongs
to root could be read there even without capabilities."""
_NAMESPACES = (
    *("--cap-drop", "ALL", "--unshare-pid", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"),
    *("--die-with-parent", "--new-session"),
)


def check_bubblewrap(visible: Iterable[Path], hidden: Iterable[Path], user: int | None) -> None:
    """Check that bwrap is installed, that the kernel lets it work, and that its user can read what is to be visible.

    Raises:
        TouchlineError: it is not, or does not.
    """
    if shutil.which("bwrap") is None:
        raise TouchlineError(
            "--isolate bubblewrap needs the program bwrap; install it with: apt-get install bubblewrap"
        )
    with tempfile.TemporaryDirectory(prefix="touchline-") as folder:
        Path(folder).chmod(0o755)
        probe = [*bubblewrap(Path(folder), visible, hidden), "true"]
        try:
            tried = subprocess.run(
                probe, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PROGRAM_S, **run_as(user)
            )
        except subprocess.TimeoutExpired:
            raise TouchlineError(f"--isolate bubblewrap: bwrap does not start a program in {PROGRAM_S:g} s") from None
    if tried.returncode != 0:
        reason = (tried.stderr.strip().splitlines() or ["no reason given"])[-1]
        remedy = "allow user namespaces, or use none"
        if user is not None:
            remedy += "; robots that root launches run as nobody, who has to read Python, this library and the teams"
        raise TouchlineError(f"--isolate bubblewrap does not work here ({reason}); {remedy}")


def run_as(user: int | None) -> dict[str, Any]:
    """The arguments of `subprocess.Popen` with which a program runs as this user, in the group of the same id."""
    return {"user": user, "group": user, "extra_groups": []} if user is not None else {}


def bubblewrap(folder: Path, visible: Iterable[Path], hidden: Iterable[Path]) -> list[str]:
    """The beginning of a command line that runs the rest of it in bubblewrap.

    Args:
        folder: the working folder, which alone is writable.
        visible: what is there, read-only.
        hidden: files and folders that are not, also where they lie below something visible.
    """
    mounts = list(_mounts(visible, [path.resolve() for path in hidden]))
    made = [mounts[number + 1] for number, word in enumerate(mounts) if word == "--tmpfs"]
    return [
        "bwrap",
        *_NAMESPACES,
        *("--tmpfs", "/", "--dev", "/dev", "--proc", "/proc", "--tmpfs", "/tmp"),
        *mounts,
        *("--bind", str(folder), str(folder)),
        *(word for path in (*made, "/") for word in ("--remount-ro", path)),
        *("--chdir", str(folder)),
        "--",
    ]


def _mounts(visible: Iterable[Path], hidden: list[Path]) -> Iterator[str]:
    """The arguments that make paths visible: symlinks with their targets; each path once."""
    wanted = {path for one in visible for path in (one, one.resolve())}
    for path in sorted(wanted):
        if any(path.resolve().is_relative_to(one) for one in hidden):
            if path.is_file():  # one that is named, such as a recording among the hidden runs
                yield from ("--ro-bind", str(path), str(path))
        elif not any(above in wanted and not above.is_symlink() for above in path.parents):
            yield from _mount(path, hidden)


def _mount(path: Path, hidden: list[Path]) -> Iterator[str]:
    real = path.resolve()
    if any(real.is_relative_to(one) for one in hidden):
        return
    if path.is_symlink():
        yield from ("--symlink", str(path.readlink()), str(path))
    elif path.is_dir() and any(one.is_relative_to(real) for one in hidden):
        yield from ("--tmpfs", str(path))
        for entry in sorted(path.iterdir()):
            yield from _mount(entry, hidden)
    elif path.exists():
        yield from ("--ro-bind", str(path), str(path))
