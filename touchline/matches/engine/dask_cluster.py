"""Plays matches on the workers of a Dask scheduler. Each match has a process of its own there.

A match whose worker is lost is played again on another one; Dask does so by itself.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from runtime.process.installed import need
from runtime.process.timing import RECONNECT_S
from schemas.errors import TouchlineError

_RETRIES = 3
"""Losses of a worker after which its match is given up."""


@contextmanager
def dask_cluster(address: str, connect_s: float = RECONNECT_S) -> Iterator[tuple[Executor, int]]:
    """The executor of the scheduler at `tcp://HOST:PORT`, and the number of matches that its workers play at a time.

    That is at least 1, while no worker has joined yet. Matches that still wait at the end of the block are not played.

    Raises:
        TouchlineError: Dask is not installed, or no scheduler answers there.
    """
    need("--dask needs Dask", "cluster", "distributed")
    distributed: Any = import_module("distributed")
    try:
        client = distributed.Client(address, timeout=connect_s, set_as_default=False)
    except (OSError, ValueError) as error:
        raise TouchlineError(
            f"--dask {address}: no scheduler answers ({type(error).__name__}); start one with `dask scheduler`, "
            "and give the address that it prints, as tcp://192.168.1.5:8786"
        ) from None
    with client:
        executor: Executor = client.get_executor(pure=False, retries=_RETRIES)
        try:
            yield executor, max(1, sum(client.ncores().values()))
        finally:
            executor.shutdown(wait=False)
