import threading
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import pytest
from pytest import approx

from robot_agent.hardware import guard
from robot_agent.hardware.contract import Picture, SensorReadings
from robot_agent.hardware.dummy import Dummy
from robot_agent.hardware.guard import HardwareError
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.hardware import CallHealth, Fallback, HardwareState
from schemas.messages.radio import Motion
from support.messages import make_setup

AHEAD = Command(answers_tick=1, drive=Drive(vx=1.0))
KICK = Command(answers_tick=1, kick=Kick(mode=KickMode.GROUND, speed=3.0))


def test_hardware_that_is_not_armed_is_sensed_and_never_moved(bench, capsys):
    one = bench(armed=False)
    one.guard.start()
    one.after(0.02)
    assert one.guard.sense().motion is not None
    one.guard.actuate(KICK)
    one.guard.watch()
    assert (one.guard.state, one.hardware.calls, one.hardware.drive) == (HardwareState.INACTIVE, ["configure"], None)
    assert one.hardware.kicks == [] and one.guard.refused == ["kick: the hardware is inactive"]
    assert "--arm" in capsys.readouterr().err


def test_armed_hardware_is_configured_activated_and_at_the_end_deactivated_and_closed(bench):
    one = bench()
    one.guard.start()
    assert one.guard.state is HardwareState.ACTIVE
    one.guard.stop()
    assert one.hardware.calls == ["configure", "activate", "deactivate", "close"]
    assert one.guard.state is HardwareState.UNCONFIGURED


def test_figures_are_read_while_the_other_thread_makes_its_first_call(bench, monkeypatch):
    one = bench()
    one.guard.start()

    def figures(**numbers):
        one.guard.watch()
        return CallHealth(**numbers)

    monkeypatch.setattr(guard, "CallHealth", figures)
    assert {*one.guard.health().calls} == {"configure", "activate"}
    assert "actuate" in one.guard.health().calls


@pytest.mark.parametrize("pause", [0.0, 5.0])
def test_a_demand_gains_speed_as_the_accelerations_of_the_profile_allow_also_after_a_pause(bench, pause):
    one = bench()
    one.guard.start()
    one.after(pause)
    speeds = [actuated(one, AHEAD).vx for _ in range(30)]
    gained = [after - before for before, after in pairwise(speeds)]
    assert max(gained) == approx(0.02 * one.model.drive.acceleration) and speeds[-1] == 1.0
    assert speeds[0] <= 0.05 * one.model.drive.acceleration


def actuated(one, command, times=1):
    """The demand that the hardware has got after some ticks of this command."""
    for _ in range(times):
        one.after(0.02)
        one.guard.actuate(command)
    return one.hardware.drive


def test_demands_beyond_the_limits_are_shortened_and_counted(bench):
    one = bench()
    one.guard.start()
    drive = actuated(one, Command(answers_tick=1, drive=Drive(vx=12.0, vy=16.0, omega=-50.0)), 100)
    limits = one.model.drive
    assert (drive.vx, drive.vy) == approx((0.6 * limits.max_speed, 0.8 * limits.max_speed))
    assert drive.omega == approx(-limits.max_turn_rate)
    one.guard.actuate(Command(answers_tick=2, kick=Kick(mode=KickMode.GROUND, speed=40.0)))
    assert one.hardware.kicks[0].speed == one.model.kicker.max_ground_speed
    one.guard.actuate(AHEAD)
    assert one.guard.health().clamped == 101


@pytest.mark.parametrize(("fallback", "rests"), [(Fallback.BRAKE, Drive()), (Fallback.COAST, None)])
def test_without_a_demand_the_robot_falls_back_as_its_file_says(bench, fallback, rests):
    one = bench(fallback=fallback, watchdog=0.2)
    one.guard.start()
    actuated(one, AHEAD, 50)
    one.after(0.19)
    one.guard.watch()
    assert one.hardware.drive.vx == 1.0
    one.after(0.02)
    one.guard.watch()
    assert one.hardware.drive is None or 0.0 < one.hardware.drive.vx < 1.0, "it brakes by its deceleration"
    for _ in range(50):
        one.after(0.02)
        one.guard.watch()
    assert one.hardware.drive == rests
    health = one.guard.health()
    assert (health.fell_back, health.reason) == (1, "no demand for 0.2 s")
    one.guard.actuate(AHEAD)
    assert one.guard.health().reason == ""


@pytest.mark.parametrize("method", ["configure", "activate", "sense", "actuate"])
def test_hardware_that_raises_is_named_and_not_used_any_more(bench, method, capsys):
    model = make_setup().model_of("cyan2")
    one = bench(dummy=Dummy(model, faults={method: "[Errno 5] the cable is out"}))
    with pytest.raises(HardwareError, match=rf"^{method} raised OSError: .*the cable is out"):
        one.guard.start()
        one.guard.sense()
        one.guard.actuate(AHEAD)
    assert one.guard.state is HardwareState.ERROR
    assert "the cable is out" in one.guard.health().reason
    before = one.hardware.drive
    with pytest.raises(HardwareError):
        one.guard.sense()
    assert one.guard.watch() and one.hardware.drive is before
    one.guard.stop()
    assert one.hardware.calls[-2:] == ["deactivate", "close"]
    assert capsys.readouterr().err.count("the cable is out") == 1


@pytest.mark.parametrize(
    ("read", "said"),
    [(None, "it returned None; return SensorReadings"), (SensorReadings("now", Motion(x=0, y=0, heading=0)), "")],
)
def test_hardware_that_returns_no_readings_is_an_error_that_says_so(bench, monkeypatch, read, said):
    one = bench()
    one.guard.start()
    monkeypatch.setattr(one.hardware, "sense", lambda time: read)
    with pytest.raises(HardwareError, match=rf"^sense raised TypeError: {said}"):
        one.guard.sense()


class Stuck(Dummy):
    """Does not return from the demand of the fallback."""

    def __init__(self, model):
        super().__init__(model)
        self.free = threading.Event()

    def actuate(self, drive, kick, dribble):
        self.free.wait(20.0)


def test_a_fallback_that_does_not_return_ends_the_waiting_of_the_thread_that_senses(bench):
    one = bench(dummy=Stuck(make_setup().model_of("cyan2")), watchdog=0.05)
    one.guard.start()
    watch = threading.Thread(target=one.guard.watch)
    watch.start()
    with pytest.raises(HardwareError, match=r"actuate has not returned for 0\.05 s"):
        while True:
            one.guard.sense()
    one.hardware.free.set()
    watch.join()


class Slow(Dummy):
    """Takes as long as it is told."""

    took = 0.0

    def sense(self, time):
        self.bench.after(self.took)
        if self.took > 0.2:
            with ThreadPoolExecutor(1) as other:
                self.looks = [other.submit(self.bench.guard.watch).result() for _ in range(5)]
        return super().sense(time)


@pytest.fixture
def slow(bench):
    hardware = Slow(make_setup().model_of("cyan2"))
    hardware.bench = bench(dummy=hardware, deadline=0.02)
    hardware.bench.guard.start()
    return hardware


def test_calls_that_take_longer_than_the_deadline_are_counted_and_named_once(slow, capsys):
    for slow.took in (0.01, 0.03, 0.05):
        slow.bench.guard.sense()
    sense = slow.bench.guard.health().calls["sense"]
    assert (sense.calls, sense.late, sense.mean_ms, sense.worst_ms) == (3, 2, 30.0, 50.0)
    assert capsys.readouterr().err == "cyan2: sense takes longer than its deadline of 20 ms\n"
    assert slow.bench.guard.health().reason == "", "it is no reason to fall back"


def test_a_call_that_does_not_return_is_an_error_that_the_watching_thread_reports(slow):
    slow.took = 0.3
    slow.bench.guard.sense()
    assert slow.looks == [True] * 4 + [False], "the process may have slept, and gets time to return"
    assert slow.bench.guard.state is HardwareState.ERROR
    assert slow.bench.guard.health().reason == "sense has not returned for 0.2 s"


def test_a_class_without_a_method_of_the_contract_is_refused_before_anything_moves(bench):
    class Half:
        def configure(self):
            raise AssertionError("it is configured")

        def sense(self, time):
            raise AssertionError("it is asked")

    with pytest.raises(TouchlineError, match=r"^the hardware Half has no activate, actuate, deactivate, close; write"):
        bench(dummy=Half())


@pytest.mark.parametrize(
    "read",
    [
        SensorReadings(0.0, (0.0, 0.0, 0.0)),
        SensorReadings(0.0, Motion(x="0", y=0.0, heading=0.0)),
        SensorReadings(0.0, None, Picture(0.0, (1.0, 2.0))),
    ],
)
def test_readings_with_a_part_of_another_type_are_shown(bench, read):
    one = bench()
    one.guard.start()
    one.hardware.sense = lambda time: read
    with pytest.raises(HardwareError) as failed:
        one.guard.sense()
    assert f"sense raised TypeError: it returned {read!r:.200}; a part has another type than the contract" in str(
        failed.value
    )


def test_hardware_that_ends_the_program_has_failed_in_one_line(bench):
    one = bench()
    one.guard.start()

    def sense(time):
        raise SystemExit("no\ncamera")

    one.hardware.sense = sense
    with pytest.raises(HardwareError, match=r"^sense raised SystemExit: no camera$"):
        one.guard.sense()
    assert one.guard.state is HardwareState.ERROR


def test_a_close_that_does_not_return_says_what_the_process_waits_for(bench, capsys):
    one = bench(watchdog=0.01)
    said = ""

    def close():
        nonlocal said
        for _ in range(1000):
            said += capsys.readouterr().err
            if said:
                return
            threading.Event().wait(0.01)

    one.hardware.close = close
    one.guard.stop()
    assert "cyan2: close has not returned for 0.1 s; the process waits for it" in said
