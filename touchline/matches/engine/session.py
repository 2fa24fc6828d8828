"""What a command plays its matches with: an executor that its options ask for, progress on stderr, and Ctrl-C."""

import signal
import sqlite3
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

from schemas.errors import MatchFailedError, TouchlineError
from touchline.matches.engine.dask_cluster import dask_cluster
from touchline.matches.engine.fresh_process import FreshProcesses, cores
from touchline.matches.engine.progress import ProgressDisplay, progress_of


@dataclass(slots=True)
class Session:
    """Where the matches of a command are played, and what shows them."""

    executor: Executor
    progress: ProgressDisplay
    is_remote: bool
    """Whether the workers do not see the folder of the run."""
    is_interrupted: bool = False
    """Whether Ctrl-C or SIGTERM has ended a block of `interruptible`."""

    @contextmanager
    def interruptible(self) -> Iterator[None]:
        """Ctrl-C or SIGTERM ends the block without an exception, and is noted.

        Raises:
            MatchFailedError: something cannot be written, as on a full disk.
        """
        before = signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            yield
        except KeyboardInterrupt:
            self.is_interrupted = True
        except (OSError, sqlite3.Error) as error:
            raise MatchFailedError(f"{error}; mend that, and go on: no stored result is lost") from None
        finally:
            signal.signal(signal.SIGTERM, before)


@contextmanager
def session_of(title: str, jobs: int, dask: str | None = None, *, json: bool = False) -> Iterator[Session]:
    """Yields the session; matches that are being played at the end of the block, as after Ctrl-C, are ended.

    Args:
        title: of the bar that shows progress.
        jobs: matches at a time on this machine; 0 for one per core.
        dask: address of a Dask scheduler; None for this machine.
        json: show progress as JSON lines.

    Raises:
        TouchlineError: an option is invalid, Dask is not installed, or no scheduler answers.
    """
    if jobs < 0:
        raise TouchlineError(f"--jobs is {jobs}; give a number of matches at a time, or 0 for one per core")
    if dask is not None and jobs:
        raise TouchlineError(
            f"--jobs is {jobs}, and --dask plays one match on each thread of its workers; leave one out"
        )
    with ExitStack() as stack:
        if dask is not None:
            executor, at_once = stack.enter_context(dask_cluster(dask))
        else:
            executor, at_once = FreshProcesses(jobs or cores()), jobs or cores()
            stack.callback(executor.shutdown, cancel_futures=True)
        progress = stack.enter_context(progress_of(title, at_once=at_once, json=json))
        yield Session(executor, progress, is_remote=dask is not None)
