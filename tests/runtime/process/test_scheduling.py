"""Which programs wait for a core, and which are run at once."""

import os
import sys
import threading
from collections.abc import Iterator

import pytest

from runtime.process.scheduling import use_batch_scheduling

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="a policy of the Linux kernel")


@pytest.fixture
def thread() -> Iterator[int]:
    """The id of a thread that was there before."""
    leave, ready = threading.Event(), threading.Event()
    waits = threading.Thread(target=lambda: (ready.set(), leave.wait()))
    waits.start()
    ready.wait()
    assert waits.native_id is not None
    yield waits.native_id
    use_batch_scheduling(False)
    leave.set()
    waits.join()


def test_all_threads_of_a_program_take_turns_and_those_that_they_start(thread: int) -> None:
    use_batch_scheduling()
    begun: list[int] = []
    starts = threading.Thread(target=lambda: begun.append(os.sched_getscheduler(0)))
    starts.start()
    starts.join()
    assert [os.sched_getscheduler(0), os.sched_getscheduler(thread), *begun] == [os.SCHED_BATCH] * 3


def test_a_program_that_took_turns_is_run_at_once_again(thread: int) -> None:
    use_batch_scheduling()
    use_batch_scheduling(False)
    assert [os.sched_getscheduler(0), os.sched_getscheduler(thread)] == [os.SCHED_OTHER] * 2


def test_a_kernel_that_grants_no_policy_is_no_error(thread: int, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    use_batch_scheduling()
    assert os.sched_getscheduler(thread) == os.SCHED_OTHER
