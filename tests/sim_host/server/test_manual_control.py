"""A person drives a robot in place of its brain, and gives it back."""

import pytest

from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.manual import ManualDrive
from schemas.messages.radio import Radio
from schemas.topics import BELIEF, INVALID, MANUAL


class Talker:
    """Drives ahead and sends a radio message."""

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), radio=Radio(role="talker"))


BACK = ManualDrive(drive=Drive(vx=-1.0))


@pytest.mark.parametrize("rig_name", ["rig", "realtime_rig"])
def test_manual_control_replaces_the_brain_until_it_gives_the_robot_back(rig_name, request):
    rig = request.getfixturevalue(rig_name)
    hand = rig.outside.publisher(MANUAL, robot="cyan2")
    rig.ticks(2)
    rig.inputs("cyan2")
    hand.put(BACK)
    rig.ticks(2)
    assert [given.drive.vx for given in rig.inputs("cyan2")] == [-1.0, -1.0]
    hand.put(ManualDrive(release=True))
    rig.ticks(2)
    assert [given.drive.vx for given in rig.inputs("cyan2")] == [1.0, 1.0]
    assert rig.silences() == ["cyan2 is under manual control", "cyan2 is controlled by its brain again"]


def test_manual_control_that_falls_silent_gives_the_robot_back(realtime_rig):
    realtime_rig.outside.publisher(MANUAL, robot="cyan2").put(BACK)
    realtime_rig.ticks(1)
    realtime_rig.inputs("cyan2")
    realtime_rig.ticks(60)
    driven = [given.drive.vx for given in realtime_rig.inputs("cyan2")]
    assert driven.index(1.0) == pytest.approx(0.5 / 0.02, abs=2)


def test_a_kick_is_done_once_and_the_brain_goes_on_talking(rig):
    rig.leave("cyan2")
    rig.join("cyan2", Talker())
    beliefs = rig.listen(BELIEF)
    rig.ticks(1)
    rig.inputs("cyan2")
    kick = Kick(mode=KickMode.GROUND, speed=5.0)
    rig.outside.publisher(MANUAL, robot="cyan2").put(ManualDrive(kick=kick))
    rig.ticks(2)
    assert [given.kick for given in rig.inputs("cyan2")] == [kick, None]
    assert [belief.radio.role for belief in beliefs.all()][-1] == "talker"


def test_a_robot_without_a_brain_is_driven_too(rig):
    rig.leave("cyan2")
    rig.ticks(3)
    rig.inputs("cyan2")
    rig.outside.publisher(MANUAL, robot="cyan2").put(BACK)
    rig.ticks(1)
    assert [given.drive.vx for given in rig.inputs("cyan2")] == [-1.0]


def test_manual_control_of_a_robot_that_is_not_there_is_counted(rig):
    told = rig.listen(INVALID)
    rig.outside.publisher(MANUAL, robot="cyan9").put(BACK)
    rig.ticks(1)
    (invalid,) = told.all()
    assert (invalid.key, invalid.reason) == ("robot/cyan9/manual", "no robot of this match has that name")
