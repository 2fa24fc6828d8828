"""Plays matches in this process, one after the other: for debuggers and for tests."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any


class ThisProcess(Executor):
    """Calls each function at once."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call the function; the future has its result already."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:  # as any executor does
            future.set_exception(error)
        return future
