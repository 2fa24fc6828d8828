"""Plays matches on the workers of a Dask scheduler. Each match has a process of its own there.

A match whose worker is lost is played again on another one; Dask does so by itself.
"""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from importlib import import_module
from typing import Any

from schemas.errors import TouchlineError

CONNECT_S = 10.0
"""Wall time to reach a scheduler, s."""
_RETRIES = 3
"""Losses of a worker after which its match is given up."""


class DaskCluster(Executor):
    """The workers of one scheduler."""

    def __init__(self, address: str) -> None:
        """Connect to `tcp://HOST:PORT`.

        Raises:
            TouchlineError: Dask is not installed, or no scheduler answers there.
        """
        try:
            distributed: Any = import_module("distributed")
        except ImportError:
            raise TouchlineError('--dask needs Dask; install it with: pip install "touchline[cluster]"') from None
        try:
            self._client = distributed.Client(address, timeout=CONNECT_S, set_as_default=False)
        except (OSError, ValueError) as error:
            raise TouchlineError(
                f"--dask {address}: no scheduler answers ({type(error).__name__}); start one with `dask scheduler`, "
                "and give the address that it prints, as tcp://192.168.1.5:8786"
            ) from None
        self._executor = self._client.get_executor(pure=False, retries=_RETRIES)

    @property
    def threads(self) -> int:
        """The matches that its workers play at a time; at least 1, while no worker has joined yet."""
        threads: dict[str, int] = self._client.ncores()
        return max(1, sum(threads.values()))

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call the function on a worker."""
        future: Future[Any] = self._executor.submit(fn, *args, **kwargs)
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Leave the scheduler; with `cancel_futures`, what waits for a worker is not called any more."""
        self._executor.shutdown(wait and not cancel_futures)
        self._client.close()
