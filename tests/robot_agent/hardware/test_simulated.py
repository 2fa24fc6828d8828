"""The hardware `simulated`: its bytes, its board, its driver, and its process."""

import math
import os
import random
import time

import pytest
from msgspec import ValidationError
from pytest import approx

from robot_agent.hardware.guard import HardwareError, HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from robot_agent.hardware.simulated import frames
from robot_agent.hardware.simulated.driver import Simulated
from robot_agent.hardware.simulated.frames import FrameReader, Kind, Motion, Seen
from schemas.messages.command import Command, Drive, Kick, KickMode
from support.messages import make_setup
from support.stepped_board import SteppedBoard

QUIET = {"position_noise": 0.0, "heading_noise": 0.0, "velocity_noise": 0.0, "camera_noise": 0.0}
MOTION = Motion(7000.000012, 6999.5, 6999.507, -12.3456, 7.0001, 3.1415, -3.25, 0.5, -12.5, True, False)
SEEN = Seen(0.08, (1.5, -2.25, 4.0, -0.125), [(1.0, 2.0, 0.26), (-30.5, 0.0, 0.25)])


@pytest.fixture
def stepped():
    made = []

    def make(profile="msl", **numbers):
        made.append(SteppedBoard(make_setup(profile).model_of("cyan2"), **{**QUIET, **numbers}))
        made[-1].hardware.configure()
        return made[-1]

    yield make
    for one in made:
        one.hardware.close()
        one.close()


def test_what_is_framed_is_read_again_in_pieces_of_any_length():
    sent = frames.motion(MOTION) + frames.picture(SEEN) + frames.demand(5.25, [1.0, -0.5, 0.25], True)
    sent += frames.power(True) + frames.demand(0.0, None, False) + frames.kick(Kick(mode=KickMode.LOB, speed=6.5))
    reader, dice, found = FrameReader(), random.Random(1), []
    while sent:
        size = dice.randint(1, 9)
        found += reader.feed(sent[:size])
        sent = sent[size:]
    assert frames.read_motion(found[0].content) == MOTION
    assert frames.read_picture(found[1].content) == SEEN
    assert frames.read_demand(found[2].content) == (5.25, [1.0, -0.5, 0.25], True)
    assert (found[3].kind, found[3].content) == (Kind.POWER, b"\x01")
    assert frames.read_demand(found[4].content) == (0.0, None, False)
    assert frames.read_kick(found[5].content) == Kick(mode=KickMode.LOB, speed=6.5)
    assert reader.wrong == 0


def test_a_frame_in_which_any_bit_has_changed_is_left_out_and_the_next_one_is_read():
    whole, next_one = frames.motion(MOTION), frames.power(True)
    for bit in range(8 * len(whole)):
        broken = bytearray(whole)
        broken[bit // 8] ^= 1 << bit % 8
        reader = FrameReader()
        found = [*reader.feed(bytes(broken) + next_one), *reader.feed(b"\x00" * 300), *reader.feed(next_one)]
        assert found and all(one.kind == Kind.POWER for one in found), bit
        assert reader.wrong >= (bit >= 24), bit


def test_noise_on_the_line_is_no_frame():
    reader = FrameReader()
    assert list(reader.feed(random.Random(3).randbytes(100_000))) == []
    assert list(reader.feed(bytes(300) + frames.power(False)))[-1].kind == Kind.POWER


@pytest.mark.parametrize(("profile", "drive"), [("omni", Drive(vx=0.6, vy=-0.8)), ("differential", Drive(vx=1.0))])
def test_wheels_carry_out_the_velocity_after_latency_and_acceleration(stepped, profile, drive):
    one = stepped(profile, latency=0.05, acceleration=2.0)
    one.hardware.activate()
    for _ in range(100):
        one.hardware.actuate(drive, None, False)
        one.after(0.02)
    readings = one.hardware.sense(one.clock.now())
    assert (readings.motion.vx, readings.motion.vy) == approx((drive.vx, drive.vy), abs=2e-3)
    assert math.hypot(readings.motion.x, readings.motion.y) == approx(2.0 - 0.05 - 0.25, abs=0.03)


@pytest.mark.parametrize(("drive", "x"), [(Drive(), 0.0), (None, 1.0)])
def test_without_demands_the_board_brakes_and_without_power_it_rolls_on(stepped, drive, x):
    one = stepped()
    one.hardware.activate()
    for _ in range(100):
        one.hardware.actuate(Drive(vx=1.0), None, False)
        one.after(0.02)
    if drive is None:
        one.hardware.actuate(None, None, False)
        one.after(0.1)
        assert one.board.twist[0] == approx(1.0, abs=0.1)
    one.after(1.0)
    assert one.board.twist[0] == approx(0.0, abs=1e-6)


def test_a_board_without_power_does_not_move(stepped):
    one = stepped()
    one.hardware.actuate(Drive(vx=1.0), Kick(mode=KickMode.GROUND, speed=3.0), True)
    one.after(1.0)
    assert one.hardware.sense(one.clock.now()).motion.x == 0.0


def test_the_ball_is_dribbled_and_kicked_and_seen(stepped):
    one = stepped(ball=(1.0, 0.0), posts=((0.0, 3.0),))
    one.hardware.activate()
    for _ in range(100):
        one.hardware.actuate(Drive(vx=0.8), None, True)
        one.after(0.02)
    readings = one.hardware.sense(one.clock.now())
    assert readings.holding and readings.picture.ball.x == approx(0.37, abs=0.02)
    assert readings.picture.obstacles[0].y == approx(3.0, abs=0.01)
    one.hardware.actuate(Drive(), Kick(mode=KickMode.GROUND, speed=4.0), False)
    one.after(0.2)
    readings = one.hardware.sense(one.clock.now())
    assert not readings.holding and readings.picture.ball.vx == approx(4.0, abs=0.1)


def test_pictures_come_late_by_a_delay_that_the_driver_is_told(stepped):
    one = stepped(picture_delay=0.1, camera_rate=10.0, posts=((2.0, 0.0),))
    delayed = SteppedBoard(make_setup().model_of("cyan2"), 0.1, picture_delay=0.1, camera_rate=10.0)
    delayed.hardware.configure()
    for board, age in ((one, 0.0), (delayed, 0.1)):
        board.after(0.5)
        picture = board.hardware.sense(board.clock.now()).picture
        assert board.clock.now() - picture.time == approx(age, abs=1e-6)
    delayed.hardware.close()
    delayed.close()


def test_frames_that_the_line_has_changed_are_left_out_and_counted(stepped, capsys):
    one = stepped()
    one.clock.alters = lambda data: data.replace(b"\xa5\x5a\x10", b"\xa5\x5a\x11")
    one.after(0.2)
    guard = guard_of(one.hardware, one.clock)
    assert guard.sense().motion is None
    assert guard.health().devices["line"].refused > 10
    assert "cyan2: line: messages of devices cannot be read" in capsys.readouterr().err


def guard_of(hardware, clock):
    model = make_setup().model_of("cyan2")
    return HardwareGuard(hardware, HardwareSettings(hardware="simulated"), model, "cyan2", clock, armed=True)


def test_a_board_that_has_gone_is_an_error_with_its_reason(stepped):
    one = stepped()
    guard = guard_of(one.hardware, one.clock)
    guard.start()
    one.hardware.close()
    with pytest.raises(HardwareError, match=r"^sense raised OSError: the serial line is not open$"):
        guard.sense()


def test_the_board_is_a_process_behind_a_pty_that_ends_with_its_driver():
    hardware = Simulated(make_setup().model_of("cyan2"), start=(1.0, 2.0, 0.0), **QUIET)
    hardware.configure()
    pid = hardware.board_pid
    hardware.activate()
    began = time.perf_counter()
    moved = 0.0
    while moved < 1.2 and time.perf_counter() - began < 20.0:
        hardware.actuate(Drive(vx=0.5), None, False)
        time.sleep(0.02)
        motion = hardware.sense(time.perf_counter() - began).motion
        moved = motion.x if motion is not None else moved
    assert moved >= 1.2
    hardware.deactivate()
    hardware.close()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_a_board_without_such_a_number_is_refused():
    with pytest.raises(TypeError, match="top_speed"):
        Simulated(make_setup().model_of("cyan2"), top_speed=9.0)


def test_a_command_goes_through_guard_driver_line_and_board(stepped):
    one = stepped()
    guard = guard_of(one.hardware, one.clock)
    guard.start()
    for _ in range(150):
        one.after(0.02)
        guard.sense()
        guard.actuate(Command(answers_tick=1, drive=Drive(vx=99.0 / 10)))
    assert one.board.twist[0] == approx(one.board.numbers.max_speed, abs=1e-3), "the motors are weaker than the profile"
    guard.stop()
    one.after(0.05)
    assert not one.board.powered


@pytest.mark.parametrize("numbers", [{"start": [-3.0]}, {"max_speed": "3"}, {"strt": [0.0, 0.0, 0.0]}])
def test_numbers_that_no_board_can_have_are_refused_before_one_is_started(numbers):
    with pytest.raises((ValidationError, TypeError), match=r"start|max_speed|strt"):
        Simulated(make_setup("msl").model_of("cyan2"), **numbers)
