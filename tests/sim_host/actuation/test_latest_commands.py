"""From commands to inputs: the newest counts, kicks are of their moment, and silence brakes."""

from schemas.messages.command import Command, Drive, Kick, KickMode
from sim_host.actuation.latest_commands import CommandLimits, LatestCommands

NAMES = ("cyan1", "magenta1")
GO = Drive(vx=2.0)
LIMITS = CommandLimits(age=10, silence=500)
"""The watchdog alone brakes."""
BOTH = CommandLimits(age=10, silence=3)


def command(tick: int, kick: Kick | None = None) -> Command:
    return Command(answers_tick=tick, drive=GO, dribble=True, kick=kick)


def test_a_robot_without_a_command_rests() -> None:
    inputs = LatestCommands(NAMES, LIMITS).inputs(0, {})
    assert all(one.drive == Drive() and not one.dribble for one in inputs.values())


def test_a_command_stands_until_the_watchdog_and_not_a_tick_longer() -> None:
    """0.2 s are ten ticks; then the robot brakes and its dribbler stops."""
    commands = LatestCommands(NAMES, LIMITS)
    commands.inputs(5, {"cyan1": command(5)})
    assert commands.inputs(15, {})["cyan1"].drive == GO
    silent = commands.inputs(16, {})["cyan1"]
    assert silent.drive == Drive() and not silent.dribble


def test_a_stale_command_from_a_broken_link_moves_no_robot() -> None:
    assert LatestCommands(NAMES, LIMITS).inputs(100, {"cyan1": command(50)})["cyan1"].drive == Drive()


def test_a_kick_belongs_to_the_tick_its_command_arrives_in() -> None:
    commands = LatestCommands(NAMES, LIMITS)
    first = commands.inputs(1, {"cyan1": command(1, Kick(mode=KickMode.GROUND, speed=3))})["cyan1"]
    second = commands.inputs(2, {})["cyan1"]
    assert (first.kick is not None, first.answers_tick) == (True, 1)
    assert (second.kick, second.answers_tick, second.drive) == (None, None, GO)


def test_each_robot_has_its_own_commands() -> None:
    inputs = LatestCommands(NAMES, LIMITS).inputs(1, {"cyan1": command(1)})
    assert inputs["magenta1"].drive == Drive()


def test_a_robot_whose_commands_stop_brakes_in_the_third_tick_without_one() -> None:
    """0.06 s are three ticks."""
    commands = LatestCommands(NAMES, BOTH)
    commands.inputs(5, {"cyan1": command(5)})
    assert commands.inputs(6, {})["cyan1"].drive == GO
    assert commands.inputs(7, {})["cyan1"].drive == GO
    silent = commands.inputs(8, {})["cyan1"]
    assert silent.drive == Drive() and not silent.dribble
    assert commands.inputs(9, {"cyan1": command(8)})["cyan1"].drive == GO


def test_commands_that_a_link_delays_are_in_force_as_long_as_one_arrives_every_tick() -> None:
    """120 ms there and back: each command is six ticks old when it arrives."""
    commands = LatestCommands(NAMES, BOTH)
    assert all(commands.inputs(tick, {"cyan1": command(tick - 6)})["cyan1"].drive == GO for tick in range(6, 40))


def test_robots_that_remain_keep_the_time_of_their_last_command() -> None:
    commands = LatestCommands(NAMES, BOTH)
    commands.inputs(5, {name: command(5) for name in NAMES})
    changed = commands.with_roster(("cyan1",), BOTH, ())
    assert changed.inputs(7, {})["cyan1"].drive == GO
    assert changed.inputs(8, {})["cyan1"].drive == Drive()


def test_a_brain_that_thinks_for_five_ticks_does_not_brake_once_its_rhythm_is_known() -> None:
    """100 ms of thought in real time: a command every fifth tick, five ticks old when it arrives."""
    commands = LatestCommands(NAMES, BOTH)
    answers = {tick: {"cyan1": command(tick - 5)} for tick in range(5, 60, 5)}
    inputs = {tick: commands.inputs(tick, answers.get(tick, {}))["cyan1"] for tick in range(5, 60)}
    assert [tick for tick, given in inputs.items() if given.drive != GO] == [8, 9]


def test_a_pause_is_allowed_once_more_and_not_for_ever() -> None:
    commands = LatestCommands(NAMES, BOTH)
    for tick in (1, 6, 7):
        commands.inputs(tick, {"cyan1": command(tick)})
    assert [commands.inputs(tick, {})["cyan1"].drive == GO for tick in (8, 9, 10)] == [True, True, False]
