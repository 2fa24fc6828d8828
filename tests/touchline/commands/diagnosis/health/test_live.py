"""The live ledger of robots on hardware, whose reports come from the robots themselves."""

import pytest

from robot_agent.hardware.dummy import Dummy
from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.topics import HARDWARE
from support.in_process_bus import SharedState
from support.messages import make_setup
from support.stepped_clock import SteppedClock
from touchline.commands.diagnosis.health.live import LiveLedgers
from touchline.commands.diagnosis.health.tables import ledger_view
from touchline.launch.terminal.console import console


class Passing(SteppedClock):
    """A little time passes with each look."""

    def now(self):
        self.sleep_until(super().now() + 0.01)
        return super().now()


@pytest.fixture
def buses():
    shared = SharedState()
    return [shared.open_bus("friendly", Passing()) for _ in range(2)]


def test_without_a_host_the_reports_of_robots_on_hardware_are_shown(buses, capsys):
    robot, watcher = buses
    model = make_setup().model_of("cyan2")
    guard = HardwareGuard(Dummy(model), HardwareSettings(hardware="dummy"), model, "cyan2", SteppedClock(), armed=True)
    guard.start()
    guard.sense()
    guard.actuate(Command(answers_tick=1, drive=Drive(vx=19.0)))
    robot.publisher(HARDWARE, robot="cyan2").put(guard.health())
    robot.publisher(HARDWARE, robot="cyan3").put(guard.health())  # a report on another robot's key
    ledger = LiveLedgers(watcher, 0.5).newest()
    assert list(ledger.hardware) == ["cyan2"]
    shown = console()
    shown.width = 200
    shown.print(ledger_view(ledger))
    printed = capsys.readouterr().out
    assert "no host" in printed and "active, armed" in printed and "sense()" in printed
    assert "cyan2: 1 demands shortened, 0 filtered, fell back 0 times" in printed


def test_with_neither_a_host_nor_robots_on_hardware_the_host_is_missed(buses):
    with pytest.raises(TouchlineError, match="host"):
        LiveLedgers(buses[1], 0.5)
