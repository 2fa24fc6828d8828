"""The velocity in bytes of a node, against rosbags."""

import pytest

pytest.importorskip("xxhash")

from robot_agent.ros2.velocity import Velocity, read_velocity
from runtime.ros2 import topic_type as types
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.message_types import typestore


def encoded(*, is_stamped: bool, frame: str = "base_link", is_little: bool = True) -> bytes:
    build = MessageBuilder()
    message, kind = build.twist(1.25, -0.5, 3.0, 0.75), types.TWIST
    if is_stamped:
        kind = types.TWIST_STAMPED
        message = build.make(kind.message, build.header(build.stamp(12_345_678_901), frame), message)
    return bytes(typestore().serialize_cdr(message, kind.message, little_endian=is_little))


@pytest.mark.parametrize("is_little", [True, False])
@pytest.mark.parametrize("frame", ["", "a", "abcd", "abcdefg", "cyan1/base_link", "ä" * 30])
def test_the_velocity_is_that_of_the_message_whatever_its_frame_and_byte_order(frame: str, is_little: bool) -> None:
    payload = encoded(is_stamped=True, frame=frame, is_little=is_little)
    assert read_velocity(payload, is_stamped=True) == Velocity(12_345_678_901, 1.25, -0.5, 0.75)


def test_a_message_without_a_stamp_has_none() -> None:
    assert read_velocity(encoded(is_stamped=False), is_stamped=False) == Velocity(0, 1.25, -0.5, 0.75)


def test_a_time_before_the_start_is_negative() -> None:
    payload = bytearray(encoded(is_stamped=True))
    payload[4:8] = b"\xff\xff\xff\xff"
    assert read_velocity(bytes(payload), is_stamped=True).stamp_ns == -1_000_000_000 + 345_678_901


def test_padding_to_four_bytes_may_follow() -> None:
    payload = encoded(is_stamped=True)
    assert read_velocity(payload + b"\x00" * 3, is_stamped=True) == read_velocity(payload, is_stamped=True)


@pytest.mark.parametrize("is_stamped", [True, False])
def test_bytes_of_another_form_are_refused(is_stamped: bool) -> None:
    payload = encoded(is_stamped=is_stamped)
    for number in range(len(payload)):
        with pytest.raises(ValueError, match=r"begins with|bytes"):
            read_velocity(payload[:number], is_stamped=is_stamped)
    for other in (payload + b"\x00" * 4, b"\x00\x03" + payload[2:], encoded(is_stamped=not is_stamped)):
        with pytest.raises(ValueError, match=r"begins with|bytes"):
            read_velocity(other, is_stamped=is_stamped)
    long_frame = payload[:12] + b"\xff\xff\xff\xff" + payload[16:]
    if is_stamped:
        with pytest.raises(ValueError, match="bytes"):
            read_velocity(long_frame, is_stamped=True)
