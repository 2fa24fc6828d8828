"""The hardware `simulated`: the driver of a motor controller on a serial line."""

import os
import subprocess
import sys
import tty
from contextlib import suppress
from typing import Any

import msgspec

from robot_agent.hardware.contract import BodyBall, Picture, SensorReadings
from robot_agent.hardware.simulated import frames
from robot_agent.hardware.simulated.board import BoardNumbers, settings_line
from robot_agent.hardware.simulated.device_clock import DeviceClock
from robot_agent.hardware.simulated.frames import FrameReader, Kind
from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive, Kick
from schemas.messages.radio import Motion
from schemas.messages.sight import Obstacle

_ENDS_S = 2.0
"""For the board to end when its input has ended."""


class Simulated:
    """Speaks the frames of `frames` with a board: one that it starts, or one at the port that is given."""

    def __init__(self, model: RobotModel, *, port: str = "", camera_delay: float = 0.0, **numbers: Any) -> None:
        """Prepare the driver.

        Args:
            model: its wheels turn velocities into rim speeds.
            port: path of the serial line; empty to start a board.
            camera_delay: s from taking a picture to its arrival, as far as it is known.
            numbers: true numbers of the board that is started, fields of `BoardNumbers`.

        Raises:
            TypeError: a number that no board has.
            ValidationError: a number of another form.
        """
        BoardNumbers(**numbers)  # refuses unknown names, which `convert` leaves out
        self._wheels, self._board_numbers = model.wheels, msgspec.convert(numbers, BoardNumbers)
        self._port, self._delay = port, camera_delay
        self._board: subprocess.Popen[bytes] | None = None
        self._line: int | None = None
        self._reader = FrameReader()
        self._clock = DeviceClock()
        self._now: float | None = None
        """When the line was last looked at; None before that."""
        self.holding, self.charged = False, True

    @property
    def board_pid(self) -> int | None:
        """The process of the board that was started; None without one."""
        return self._board.pid if self._board is not None else None

    def configure(self) -> None:
        """Open the line; start the board where no port is given.

        Raises:
            OSError: there is no such port, or the board does not start.
        """
        self.close()
        port = self._port or self._start_board()
        self._line = os.open(port, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(self._line)

    def activate(self) -> None:
        """Power the motors."""
        self._write(frames.power(True))

    def sense(self, time: float) -> SensorReadings:
        """What has arrived: the newest pose and the newest picture, with the times of the board's own clock."""
        motion, picture, at, wrong, is_first = None, None, time, self._reader.wrong, self._now is None
        self._now = time
        for kind, content in self._reader.feed(self._read()):
            if kind == Kind.MOTION:
                read = frames.read_motion(content)
                if not is_first:  # what has waited on the line says little of the board's clock
                    self._clock.look(time, read.time, read.demanded - read.heard if read.heard else None)
                at = self._at(read.time, time)
                self.holding, self.charged = read.holding, read.charged
                motion = Motion(x=read.x, y=read.y, heading=read.heading, vx=read.vx, vy=read.vy, omega=read.omega)
            elif kind == Kind.PICTURE:
                seen = frames.read_picture(content)
                ball = BodyBall(*seen.ball) if seen.ball is not None else None
                picture = Picture(
                    self._at(seen.time, time) - self._delay, ball, tuple(Obstacle(*body) for body in seen.bodies)
                )
        wrong = self._reader.wrong - wrong
        return SensorReadings(at, motion, picture, self.holding, self.charged, unreadable=wrong)

    def actuate(self, drive: Drive | None, kick: Kick | None, dribble: bool) -> None:
        """Send rim speeds, and a kick."""
        rims = None if drive is None else self._wheels.rim_speeds(drive.vx, drive.vy, drive.omega)
        self._write(frames.demand(self._now or 0.0, rims, dribble) + (frames.kick(kick) if kick is not None else b""))

    def deactivate(self) -> None:
        """Take the power away."""
        self._write(frames.power(False))

    def close(self) -> None:
        """Close the line, and end the board that was started."""
        if self._line is not None:
            os.close(self._line)
            self._line = None
        if self._board is not None and self._board.stdin is not None and self._board.stdout is not None:
            self._board.stdin.close()
            self._board.stdout.close()
            try:
                self._board.wait(_ENDS_S)
            except subprocess.TimeoutExpired:
                self._board.kill()
                self._board.wait()
            self._board = None

    def _start_board(self) -> str:
        command = [sys.executable, "-m", "robot_agent.hardware.simulated.board"]
        self._board = board = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert board.stdin is not None and board.stdout is not None
        board.stdin.write(settings_line(self._wheels, self._board_numbers))
        board.stdin.flush()
        port = board.stdout.readline().decode().strip()
        if not port:
            raise OSError("the simulated board did not start; its log has the reason")
        return port

    def _at(self, measured: float, now: float) -> float:
        """When something was measured, by the board's clock; now, where that is not known."""
        at = self._clock.on_driver(measured)
        return now if at is None else min(at, now)

    def _read(self) -> bytes:
        data = b""
        with suppress(BlockingIOError):
            while piece := os.read(self._open_line(), 4096):
                data += piece
        return data

    def _write(self, data: bytes) -> None:
        written = os.write(self._open_line(), data)
        if written < len(data):
            raise OSError("the serial line takes nothing more; does the board read it?")

    def _open_line(self) -> int:
        if self._line is None:
            raise OSError("the serial line is not open")
        return self._line
