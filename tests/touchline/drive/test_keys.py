"""The keys that drive a robot: those of the NuBot simulation's teleoperation node, with its speeds."""

import pytest

from schemas.messages.command import Drive, Kick, KickMode
from touchline.drive.keys import (
    KEY_LASTS_S,
    KEYS,
    KeyState,
    Speeds,
    keys_in,
    manual_drive,
    press_keys,
    status,
)

SPEEDS = Speeds()
MOTION = {
    "\x1b[A": Drive(vx=1.0),
    "\x1b[B": Drive(vx=-1.0),
    "\x1b[D": Drive(vy=1.0),
    "\x1b[C": Drive(vy=-1.0),
    "\x1bOA": Drive(vx=1.0),
    ",": Drive(omega=1.0),
    ".": Drive(omega=-1.0),
}
"""What a terminal sends → where the robot goes: 1 m/s and 1 rad/s."""


@pytest.mark.parametrize("sent, drive", MOTION.items(), ids=[repr(sent) for sent in MOTION])
def test_a_key_moves_the_robot_and_a_key_let_go_lets_it_rest(sent: str, drive: Drive) -> None:
    state = press_keys(KeyState(), sent, 10.0)
    assert manual_drive(state, SPEEDS, 10.0).drive == drive
    assert manual_drive(state, SPEEDS, 10.0 + 0.9 * KEY_LASTS_S).drive == drive
    assert manual_drive(state, SPEEDS, 10.0 + KEY_LASTS_S).drive == Drive()


def test_keys_of_two_axes_count_together_and_the_last_of_one_axis_alone() -> None:
    state = press_keys(press_keys(KeyState(), "\x1b[A\x1b[D,", 1.0), "\x1b[B", 1.1)
    assert manual_drive(state, Speeds(2.0, 3.0), 1.2).drive == Drive(vx=-2.0, vy=2.0, omega=3.0)


def test_a_held_key_goes_on_for_as_long_as_it_is_repeated() -> None:
    state = KeyState()
    for tenth in range(20):
        state = press_keys(state, "\x1b[A", tenth * 0.1)
    assert manual_drive(state, SPEEDS, 2.0).drive == Drive(vx=1.0)


def test_z_switches_the_dribbler_and_x_goes_through_the_kick_modes() -> None:
    state = press_keys(KeyState(), "z", 0.0)
    assert (
        manual_drive(state, SPEEDS, 0.0).dribble and not manual_drive(press_keys(state, "z", 0.0), SPEEDS, 0.0).dribble
    )
    modes = []
    for _ in KickMode:
        modes.append(state.mode)
        state = press_keys(state, "x", 0.0)
    assert modes == list(KickMode) and state.mode is KickMode.GROUND
    assert status(state) == "dribbler on, kick ground"


def test_space_kicks_with_the_papers_speed() -> None:
    state = press_keys(KeyState(), "x ", 0.0)
    assert manual_drive(state, SPEEDS, 0.0).kick == Kick(mode=KickMode.LOB, speed=10.0)
    assert manual_drive(KeyState(), SPEEDS, 0.0).kick is None


def test_what_is_no_key_of_ours_does_nothing() -> None:
    assert keys_in("qZ\x1b[5~\x1b[1;5P\n") == []
    assert keys_in("a\x1b[Ab") == ["up"]
    assert press_keys(KeyState(), "q", 1.0) == KeyState()


def test_every_key_has_a_description() -> None:
    assert all(words for words, _ in KEYS.values())
