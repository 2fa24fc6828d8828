"""Announcements of running hosts: files by which launchers and clients of this machine find a host.

A host locks its file while it runs. The kernel releases the lock when the process ends, however it ends: a file without
a lock is stale.
"""

import fcntl
import os
import secrets
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Self

from runtime.bus.endpoint import local_endpoint
from runtime.process.whole_file import written_whole
from schemas.wire.message import Name
from schemas.wire.part import Part, decoder

_HOSTS = Path("touchline") / "hosts"


class Announcement(Part):
    """A running host."""

    endpoint: str
    """Where clients of this machine connect."""
    match: Name
    """Name of the match."""
    pid: int
    """Process id of the host."""
    folder: str
    """Working directory of the host."""
    credentials: str | None = None
    """Folder with the credentials of all accounts; None for a host that admits everybody."""

    @classmethod
    def of(cls, match: str, endpoint: str, host_credentials: Path | None = None) -> Self:
        """The announcement of this process, which listens on `endpoint`.

        `host_credentials` is the host's own file; the accounts' files are in the same folder.
        """
        return cls(
            endpoint=local_endpoint(endpoint),
            match=match,
            pid=os.getpid(),
            folder=str(Path.cwd()),
            credentials=str(host_credentials.resolve().parent) if host_credentials is not None else None,
        )


def user_folders() -> list[Path]:
    """The folders for announcements of this user's hosts: hosts use the first that can be made, clients look in all."""
    runtime, state = os.environ.get("XDG_RUNTIME_DIR"), os.environ.get("XDG_STATE_HOME")
    folders = [Path(runtime)] if runtime else []
    with suppress(RuntimeError):  # no home
        folders.append(Path(state) if state else Path.home() / ".local" / "state")
    return [folder / _HOSTS for folder in folders if folder.is_absolute()]


@contextmanager
def announced(announcement: Announcement, path: Path) -> Iterator[None]:
    """Keep an announcement in a file within the block.

    Raises:
        OSError: the file cannot be written.
    """
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    with ExitStack() as stack:
        with written_whole(path, private=True) as draft:
            file = stack.enter_context(draft.open("w", encoding="utf-8"))
            fcntl.flock(file, fcntl.LOCK_EX)  # first: a file of this name is always complete and locked
            file.write(announcement.json() + "\n")
            file.flush()
        try:
            yield
        finally:
            path.unlink(missing_ok=True)


@contextmanager
def announced_to_user(announcement: Announcement) -> Iterator[None]:
    """Keep an announcement in the first of the user's folders that can be written, within the block.

    Raises:
        OSError: none of them can be written.
    """
    name = f"{announcement.pid}-{secrets.token_hex(4)}.json"
    with ExitStack() as stack:
        error = OSError("this user has no folder for files of running programs")
        for folder in user_folders():
            try:
                stack.enter_context(announced(announcement, folder / name))
            except OSError as refusal:
                error = refusal
            else:
                break
        else:
            raise error
        yield


def announcement_in(path: Path, *, tidy: bool = False) -> Announcement | None:
    """The announcement of a host that runs; None without one. `tidy` removes the file of one that has ended."""
    # no such file; another version's; this user may only read
    with suppress(OSError, ValueError), path.open(encoding="utf-8") as file:
        if not _is_stale(file.fileno()):
            found: Announcement = decoder(Announcement).decode(file.read())
            return found
        if tidy:
            path.unlink()
    return None


def running_hosts() -> list[Announcement]:
    """This user's running hosts on this machine; files of hosts that have ended are removed."""
    paths = [path for folder in user_folders() for path in sorted(folder.glob("*.json"))]
    return [found for path in paths if (found := announcement_in(path, tidy=True)) is not None]


def _is_stale(handle: int) -> bool:
    """Whether the process that wrote the file has ended."""
    try:
        fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
