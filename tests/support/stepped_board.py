"""The hardware `simulated` on a clock that is stepped: its driver, a serial line, and the board in this process."""

import os
import random
import tty
from contextlib import suppress
from typing import Any

from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from robot_agent.hardware.simulated.board import Board, BoardNumbers
from robot_agent.hardware.simulated.driver import Simulated
from robot_agent.process.hardware_runner import RunnerWithoutHost
from robot_agent.sdk.contract import Brain
from schemas.config.robot_model import RobotModel
from schemas.messages.setup import Setup
from schemas.topics import COMMAND
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from touchline.hardware.robot_track import RobotTrack


class BoardClock(SteppedClock):
    """While it sleeps, the board moves on, and what it sends is on the line."""

    def __init__(self, board: Board, line: int) -> None:
        super().__init__()
        self._board, self._line = board, line
        self.alters = lambda data: data
        """Changes what the board sends."""
        self.late: random.Random | None = None
        """Makes both processes late, as a busy machine does; None for processes that have a core at once."""

    def sleep_until(self, moment: float) -> None:
        if self.late is not None:
            moment += min(0.03, self.late.expovariate(1.0 / 0.003))
        step = 0.001  # a demand wakes the board
        while self.now() < moment:
            if self.late is not None:
                step += min(0.03, self.late.expovariate(1.0 / 0.004))
            super().sleep_until(min(moment, self.now() + step))
            sent = self.alters(self._board.advance(self.now()))
            with suppress(BlockingIOError):
                self._board.receive(os.read(self._line, 65536))
            with suppress(BlockingIOError):  # as on the real line, what nobody reads is lost
                os.write(self._line, sent)
            step = 0.004


def track_on_board(
    brain: Brain, robot: str, setup: Setup, seconds: float, *, late: random.Random | None = None, **numbers: Any
) -> RobotTrack:
    """What a robot perceives and commands in so many s on simulated hardware with these true numbers.

    `late` is as that of the clock.
    """
    model = setup.model_of(robot)
    stepped = SteppedBoard(model, **numbers)
    stepped.clock.late = late
    bus = SharedState().open_bus("friendly", stepped.clock)
    commands = bus.subscribe(COMMAND)
    settings = HardwareSettings(hardware="simulated")
    guard = HardwareGuard(stepped.hardware, settings, model, robot, stepped.clock, armed=True)
    guard.start()
    runner, track = RunnerWithoutHost(guard, setup, bus, brain, robot), RobotTrack(robot, [], [])
    while stepped.clock.now() < seconds:
        sight = runner.next_sight(None)
        if sight is not None:
            runner.answer(sight)
            answer = commands.receive()
            track.sights.append(sight)
            track.commands.append(answer.message() if answer is not None else None)
    guard.stop()
    stepped.close()
    return track


class SteppedBoard:
    """The driver `hardware`, the `board`, and the `clock` of both."""

    def __init__(self, model: RobotModel, camera_delay: float = 0.0, **numbers: Any) -> None:
        self.line, self._other_end = os.openpty()
        tty.setraw(self._other_end)
        os.set_blocking(self.line, False)
        self.board = Board(model.wheels, BoardNumbers(**numbers))
        self.clock = BoardClock(self.board, self.line)
        self.hardware = Simulated(model, port=os.ttyname(self._other_end), camera_delay=camera_delay)

    def after(self, seconds: float) -> None:
        """Let time pass."""
        self.clock.sleep_until(self.clock.now() + seconds)

    def close(self) -> None:
        """Close the line."""
        os.close(self.line)
        os.close(self._other_end)
