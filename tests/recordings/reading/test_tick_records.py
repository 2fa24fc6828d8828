"""The robots of a recording whose inputs are compared with recorded commands."""

from recordings.reading.command_check import CommandCheck, CommandMismatch
from recordings.reading.tick_index import Segment, StartTick
from recordings.reading.tick_records import command_check_of
from schemas.messages.applied import Applied, AppliedInput
from schemas.messages.command import Drive
from schemas.messages.soccer.game import GameEvent
from schemas.soccer.game import EventKind
from support.recorder_rig import ROBOTS, RecorderRig

WITHOUT_COMMANDS = {name: AppliedInput(drive=Drive(vx=2.0), dribble=False, answers_tick=200) for name in ROBOTS}
"""Inputs that claim to be commands which were not recorded."""


def test_inputs_of_a_robot_under_manual_control_are_not_compared_with_commands(rig: RecorderRig) -> None:
    event = GameEvent(
        tick=0, time=0.0, clock=0.0, kind=EventKind.AGENT, rule="manual_control", robot="cyan1", text="driven"
    )
    rig.host.writers["game/event"].put(event)
    rig.play(range(10))
    rig.leave()

    check = command_check_of(rig.read(), Segment(range(10), StartTick(0, None, ()), (0.0, 0.2), 0))
    check.add_applied(Applied(tick=201, time=4.02, inputs=WITHOUT_COMMANDS, chain="00"))
    assert [mismatch.robot for mismatch in check.mismatches()] == ["cyan2", "magenta1", "magenta2"]


def test_a_command_that_is_recorded_after_its_input_is_compared_with_it(rig: RecorderRig) -> None:
    rig.play(range(10))
    rig.leave()
    recording = rig.read()
    check = CommandCheck(ROBOTS, ROBOTS, 0)
    (recorded, command) = next(
        (one, sent) for one, sent in recording.decoded("robot/cyan2/command") if sent.answers_tick == 4
    )
    applied = AppliedInput(drive=Drive(vx=command.drive.vx + 1.0), dribble=command.dribble, answers_tick=4)
    check.add_applied(Applied(tick=5, time=0.1, inputs={"cyan2": applied}, chain="00"))
    check.add_command(recorded)
    mismatch = check.mismatches()[0]
    assert mismatch == CommandMismatch(5, "cyan2", "drive.vx", command.drive.vx + 1.0, command.drive.vx)
