import pytest

from recordings.recorder.no_match_notice import with_no_match_notice
from runtime.bus.contract import PresenceKind
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


@pytest.mark.parametrize(("host_at", "count"), [(0.0, 0), (2.0, 0), (5.0, 1), (None, 1)])
def test_a_match_that_the_host_does_not_play_is_reported_once(host_at: float | None, count: int) -> None:
    medium, clock = SharedState(), SteppedClock()
    lines: list[str] = []
    should_stop = with_no_match_notice(medium.open_bus("cup", clock), lines.append, lambda: clock.now() >= 9.0)
    host = medium.open_bus("cup", SteppedClock())
    while not should_stop():
        if clock.now() == host_at:
            host.declare_alive(PresenceKind.HOST, "host")
        clock.sleep_until(clock.now() + 0.5)
    assert lines == ['waiting for match "cup", which the host does not play; is that its --match?'] * count
