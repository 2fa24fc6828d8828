"""The executor that the options of a command ask for: processes of this machine, or the workers of a cluster."""

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass

from schemas.errors import TouchlineError
from touchline.matches.engine.fresh_process import FreshProcesses, cores


@dataclass(frozen=True, slots=True)
class ChosenExecutor:
    """Where matches are played."""

    executor: Executor
    at_once: int
    """Most matches that it plays at a time."""
    is_remote: bool = False
    """Whether its workers do not see the folder of the run."""


@contextmanager
def chosen_executor(jobs: int, dask: str | None) -> Iterator[ChosenExecutor]:
    """Yields the executor; matches that are played at the end of the block, as after Ctrl-C, are ended.

    Args:
        jobs: matches at a time on this machine; 0 for one per core.
        dask: address of a Dask scheduler; None for this machine.

    Raises:
        TouchlineError: an option is invalid, Dask is not installed, or no scheduler answers.
    """
    if jobs < 0:
        raise TouchlineError(f"--jobs is {jobs}; give a number of matches at a time, or 0 for one per core")
    if jobs and dask is not None:
        raise TouchlineError(
            f"--jobs is {jobs}, and --dask plays one match on each thread of its workers; leave one out"
        )
    chosen = _local(jobs or cores()) if dask is None else _cluster(dask)
    try:
        yield chosen
    finally:
        chosen.executor.shutdown(cancel_futures=True)


def _local(jobs: int) -> ChosenExecutor:
    return ChosenExecutor(FreshProcesses(jobs), jobs)


def _cluster(address: str) -> ChosenExecutor:
    from touchline.matches.engine.executors.dask_cluster import DaskCluster

    cluster = DaskCluster(address)
    return ChosenExecutor(cluster, cluster.threads, is_remote=True)
