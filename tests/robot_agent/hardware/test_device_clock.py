"""The clock of a device on that of its driver: by waiting measurements, by demands, and while the clocks part."""

from pytest import approx

from robot_agent.hardware.simulated.device_clock import DeviceClock

AHEAD = 5.0
"""s by which the driver's clock is ahead."""


def test_before_the_first_look_nothing_is_known_then_the_shortest_wait_counts():
    clock = DeviceClock()
    assert clock.on_driver(1.0) is None
    for wait in (0.012, 0.004, 0.009):
        clock.look(AHEAD + 1.0 + wait, 1.0, None)
    assert clock.on_driver(2.0) == approx(AHEAD + 2.004, abs=1e-5)


def test_a_demand_that_came_at_once_tells_more_and_late_ones_change_nothing():
    clock = DeviceClock()
    clock.look(AHEAD + 0.02, 0.01, None)
    clock.look(AHEAD + 0.04, 0.03, AHEAD - 0.001)
    for tick, late in enumerate((0.015, 0.003, 0.03)):
        clock.look(AHEAD + 0.06 + 0.02 * tick, 0.05 + 0.02 * tick, AHEAD - late)
    assert clock.on_driver(0.07) == approx(AHEAD + 0.069, abs=1e-5)


def test_clocks_that_part_are_followed():
    clock = DeviceClock()
    for second in range(600):
        device = second * (1.0 + 50e-6)
        clock.look(float(second), device, second - device - 0.0005)
    assert clock.on_driver(device) == approx(second, abs=0.001)
