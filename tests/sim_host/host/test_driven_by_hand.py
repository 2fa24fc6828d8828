"""A person drives a robot in place of its brain, and gives it back (reference 13, row 43)."""

import pytest

from arena.commands.drive import drive_by_keys
from arena.keyboard import Speeds
from schemas.command import Command, Drive, Kick, KickMode, Radio
from schemas.errors import TouchlineError
from schemas.hand import HandDrive
from schemas.topics import BELIEF, HAND, INVALID


class Talker:
    """Drives ahead and says so."""

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), radio=Radio(role="talker"))


BACK = HandDrive(drive=Drive(vx=-1.0))


@pytest.mark.parametrize("stage", ["pitch", "live"])
def test_a_hand_stands_in_for_the_brain_until_it_gives_the_robot_back(stage, request):
    pitch = request.getfixturevalue(stage)
    hand = pitch.outside.publisher(HAND, robot="cyan2")
    pitch.ticks(2)
    pitch.inputs("cyan2")
    hand.put(BACK)
    pitch.ticks(2)
    assert [given.drive.vx for given in pitch.inputs("cyan2")] == [-1.0, -1.0]
    hand.put(HandDrive(release=True))
    pitch.ticks(2)
    assert [given.drive.vx for given in pitch.inputs("cyan2")] == [1.0, 1.0]
    assert pitch.silences() == ["cyan2 is driven by hand", "cyan2 is given back to its brain"]


def test_a_hand_that_falls_silent_gives_the_robot_back(live):
    live.outside.publisher(HAND, robot="cyan2").put(BACK)
    live.ticks(1)
    live.inputs("cyan2")
    live.ticks(60)
    driven = [given.drive.vx for given in live.inputs("cyan2")]
    assert driven.index(1.0) == pytest.approx(0.5 / 0.02, abs=2)


def test_a_kick_is_done_once_and_the_brain_goes_on_talking(pitch):
    pitch.leave("cyan2")
    pitch.join("cyan2", Talker())
    beliefs = pitch.hear(BELIEF)
    pitch.ticks(1)
    pitch.inputs("cyan2")
    kick = Kick(mode=KickMode.GROUND, speed=5.0)
    pitch.outside.publisher(HAND, robot="cyan2").put(HandDrive(kick=kick))
    pitch.ticks(2)
    assert [given.kick for given in pitch.inputs("cyan2")] == [kick, None]
    assert [belief.radio.role for belief in beliefs.all()][-1] == "talker"


def test_a_robot_without_a_brain_is_driven_too(pitch):
    pitch.leave("cyan2")
    pitch.ticks(3)
    pitch.inputs("cyan2")
    pitch.outside.publisher(HAND, robot="cyan2").put(BACK)
    pitch.ticks(1)
    assert [given.drive.vx for given in pitch.inputs("cyan2")] == [-1.0]


def test_a_hand_on_a_robot_that_is_not_there_is_counted(pitch):
    told = pitch.hear(INVALID)
    pitch.outside.publisher(HAND, robot="cyan9").put(BACK)
    pitch.ticks(1)
    (invalid,) = told.all()
    assert (invalid.key, invalid.reason) == ("robot/cyan9/hand", "no robot of this match has that name")


def typed(pitch, *texts):
    """Keys that are typed one after the other while the host goes on; then Ctrl-C."""
    left = list(texts)

    def keys(timeout):
        pitch.ticks(1)
        if not left:
            raise KeyboardInterrupt
        return left.pop(0)

    return keys


def attended(pitch):
    """A seat from which a question is answered while it waits."""
    bus = pitch.seat()
    ask = bus.ask

    def ask_and_tick(*words, **more):
        answer = ask(*words, **more)
        pitch.ticks(1)
        return answer

    bus.ask = ask_and_tick
    return bus


def test_keys_drive_the_robot_and_ctrl_c_gives_it_back(pitch):
    said = []
    drive_by_keys(attended(pitch), "cyan2", typed(pitch, "\x1b[B", "z", ""), Speeds(), said.append)
    pitch.ticks(1)
    given = pitch.inputs("cyan2")
    assert [(one.drive.vx, one.dribble) for one in given[-4:]] == [
        (-1.0, False),
        (-1.0, True),
        (-1.0, True),
        (1.0, False),
    ]
    assert said == ["dribbler off, kick ground", "dribbler on, kick ground", "cyan2 is given back"]


def test_driving_a_robot_that_does_not_play_is_wrong_input(pitch):
    with pytest.raises(TouchlineError, match='robot is "cyan9", who does not play; did you mean "cyan2"'):
        drive_by_keys(attended(pitch), "cyan9", typed(pitch), Speeds(), print)
