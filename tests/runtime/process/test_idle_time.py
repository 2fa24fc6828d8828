"""Work that can wait: done while a core is idle, and also where no core ever is."""

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import nullcontext

import pytest

from runtime.process.idle_time import CoreWaitMeter, core_wait, core_wait_of, run_in_idle_time, start_thread
from runtime.process.scheduling import use_batch_scheduling
from support.process_story import wait_for

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="a policy of the Linux kernel")


@pytest.fixture(autouse=True)
def turns() -> Iterator[None]:
    """This program takes turns."""
    use_batch_scheduling()
    yield
    use_batch_scheduling(False)


class Work:
    """Some steps, and who did them."""

    def __init__(self, steps: int) -> None:
        self.left = steps
        self.by: list[tuple[int, int]] = []
        """Thread and policy of each step."""

    def step(self) -> bool:
        self.by.append((threading.get_ident(), os.sched_getscheduler(0)))
        self.left -= 1
        return self.left == 0

    @property
    def policies(self) -> list[int]:
        return [policy for _, policy in self.by]


@pytest.fixture
def busy() -> CoreWaitMeter:
    """A machine on which each step waits half a second for a core."""
    waits = iter(range(1000))
    return lambda: nullcontext(lambda: 0.5 * next(waits))


def test_a_program_that_takes_turns_works_in_idle_time_and_keeps_its_own_rank():
    work = Work(5)
    run_in_idle_time(work.step)
    assert work.policies == [os.SCHED_IDLE] * 5
    assert os.sched_getscheduler(0) == os.SCHED_BATCH


def test_a_program_that_takes_no_turns_does_it_at_once_and_itself():
    use_batch_scheduling(False)
    work = Work(5)
    run_in_idle_time(work.step)
    assert work.by == [(threading.get_ident(), os.SCHED_OTHER)] * 5


def test_with_too_little_idle_time_the_waiting_thread_continues_the_work(busy):
    work = Work(6)
    run_in_idle_time(work.step, meter=busy)
    assert work.policies == [os.SCHED_IDLE] + [os.SCHED_BATCH] * 5
    assert {thread for thread, _ in work.by[1:]} == {threading.get_ident()}


def test_a_machine_that_was_busy_is_tried_again(busy):
    work = Work(3)
    run_in_idle_time(work.step, retry_s=0.0, meter=busy)
    assert work.policies == [os.SCHED_IDLE, os.SCHED_BATCH, os.SCHED_IDLE]


def test_a_kernel_that_does_not_report_waits_is_not_trusted():
    work = Work(3)
    run_in_idle_time(work.step, retry_s=0.0, meter=lambda: nullcontext(lambda: None))
    assert work.policies == [os.SCHED_BATCH] * 3


def test_a_step_that_fails_ends_the_work_where_it_was_asked_for():
    def fails() -> bool:
        raise RuntimeError("no more")

    with pytest.raises(RuntimeError, match="no more"):
        run_in_idle_time(fails)


def test_a_thread_started_in_idle_time_has_the_policy_of_the_requesting_thread():
    born: list[int] = []

    def step() -> bool:
        thread = threading.Thread(target=lambda: born.append(os.sched_getscheduler(0)))
        start_thread(thread)
        thread.join()
        return True

    run_in_idle_time(step)
    start_thread(thread := threading.Thread(target=lambda: born.append(os.sched_getscheduler(0))))
    thread.join()
    assert born == [os.SCHED_BATCH] * 2


@pytest.mark.processes
def test_a_process_that_shares_its_core_waits_and_one_that_is_not_there_does_not():
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(cores)})
    busy = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(3)]
    os.sched_setaffinity(0, cores)
    try:
        wait_for(lambda: core_wait_of(busy[0].pid) > 0.1, "its turn")
    finally:
        for one in busy:
            one.kill()
            one.wait()
    assert core_wait_of(busy[0].pid) == 0.0


def test_the_kernel_reports_how_long_this_thread_has_waited_for_a_core():
    with core_wait() as waited_s:
        before, after = waited_s(), waited_s()
    assert before is not None
    assert after is not None
    assert 0.0 <= before <= after
