"""From commands to inputs: the newest counts, kicks are of their moment, and silence brakes."""

from schemas.messages.command import Command, Drive, Kick, KickMode
from sim_host.actuation.latest_commands import LatestCommands

NAMES = ("cyan1", "magenta1")
GO = Drive(vx=2.0)


def command(tick: int, kick: Kick | None = None) -> Command:
    return Command(answers_tick=tick, drive=GO, dribble=True, kick=kick)


def test_a_robot_without_a_command_rests() -> None:
    inputs = LatestCommands(NAMES, 10).inputs(0, {})
    assert all(one.drive == Drive() and not one.dribble for one in inputs.values())


def test_a_command_stands_until_the_watchdog_and_not_a_tick_longer() -> None:
    """0.2 s are ten ticks; then the robot brakes and its dribbler stops."""
    commands = LatestCommands(NAMES, 10)
    commands.inputs(5, {"cyan1": command(5)})
    assert commands.inputs(15, {})["cyan1"].drive == GO
    silent = commands.inputs(16, {})["cyan1"]
    assert silent.drive == Drive() and not silent.dribble


def test_a_stale_command_from_a_broken_link_moves_no_robot() -> None:
    assert LatestCommands(NAMES, 10).inputs(100, {"cyan1": command(50)})["cyan1"].drive == Drive()


def test_a_kick_belongs_to_the_tick_its_command_arrives_in() -> None:
    commands = LatestCommands(NAMES, 10)
    first = commands.inputs(1, {"cyan1": command(1, Kick(mode=KickMode.GROUND, speed=3))})["cyan1"]
    second = commands.inputs(2, {})["cyan1"]
    assert (first.kick is not None, first.answers_tick) == (True, 1)
    assert (second.kick, second.answers_tick, second.drive) == (None, None, GO)


def test_each_robot_has_its_own_commands() -> None:
    inputs = LatestCommands(NAMES, 10).inputs(1, {"cyan1": command(1)})
    assert inputs["magenta1"].drive == Drive()
