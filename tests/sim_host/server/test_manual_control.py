"""A person drives a robot in place of its brain, and gives it back."""

import pytest

from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.manual import ManualDrive
from schemas.messages.radio import Radio
from schemas.topics import BELIEF, INVALID, MANUAL
from touchline.commands.drive import drive_by_keys
from touchline.drive.keys import Speeds


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


def typed(rig, *texts):
    """Keys that are typed one after the other while the host goes on; then Ctrl-C."""
    left = list(texts)

    def keys(timeout):
        rig.ticks(1)
        if not left:
            raise KeyboardInterrupt
        return left.pop(0)

    return keys


def attended(rig):
    """A bus whose queries are answered while it waits."""
    bus = rig.seat()
    query = bus.query

    def query_and_tick(*words, **more):
        reply = query(*words, **more)
        rig.ticks(1)
        return reply

    bus.query = query_and_tick
    return bus


def test_keys_drive_the_robot_and_ctrl_c_gives_it_back(rig):
    said = []
    drive_by_keys(attended(rig), "cyan2", typed(rig, "\x1b[B", "z", ""), Speeds(), said.append)
    rig.ticks(1)
    given = rig.inputs("cyan2")
    assert [(one.drive.vx, one.dribble) for one in given[-4:]] == [
        (-1.0, False),
        (-1.0, True),
        (-1.0, True),
        (1.0, False),
    ]
    assert said == ["dribbler off, kick ground", "dribbler on, kick ground", "cyan2 is returned to its brain"]


def test_driving_a_robot_that_does_not_play_is_wrong_input(rig):
    with pytest.raises(TouchlineError, match='robot is "cyan9", which does not play; did you mean "cyan2"'):
        drive_by_keys(attended(rig), "cyan9", typed(rig), Speeds(), print)
