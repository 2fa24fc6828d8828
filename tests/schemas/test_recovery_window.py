"""The numbers that hosts and recorders go by agree with each other."""

from schemas import recovery_window as window


def test_a_host_that_waits_keeps_all_that_a_recorder_may_have_missed():
    assert window.RUN_AHEAD_TICKS + window.REST_TICKS < window.KEPT_BATCHES * window.BATCH_TICKS / 4


def test_a_recorder_that_works_makes_no_host_wait():
    assert window.REST_TICKS + window.REPORT_TICKS + window.BATCH_TICKS < window.RUN_AHEAD_TICKS / 2
