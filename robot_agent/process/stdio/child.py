"""A program as a child process: lines into its standard input, lines from its standard output, neither ever blocking.

The child ends with this process, by whatever this process ends. Its standard error is this process's: the robot's
log.
"""

import fcntl
import os
import select
import signal
import struct
import subprocess
import termios
from collections.abc import Sequence
from contextlib import suppress

from robot_agent.process.stdio.lines import Line, LineSplitter
from robot_agent.process.timing import PROGRAM_ENDS_S
from runtime.process.ending import ending
from runtime.process.leash import leashed
from schemas.messages.command import Command

_CHUNK = 65_536
"""Bytes of one read."""
_NOT_PASSED = ("TOUCHLINE_CONNECT", "TOUCHLINE_LAUNCH_TOKEN", "TOUCHLINE_CREDENTIALS")
"""Variables of the environment that the program has no use for: secrets of the network among them."""


class Child:
    """One running program."""

    def __init__(self, command: Sequence[str]) -> None:
        self._popen = subprocess.Popen(
            [*leashed({}), *command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={name: value for name, value in os.environ.items() if name not in _NOT_PASSED},
            bufsize=0,
        )
        assert self._popen.stdin is not None and self._popen.stdout is not None
        self._in, self._out = self._popen.stdin, self._popen.stdout
        for stream in (self._in, self._out):
            os.set_blocking(stream.fileno(), False)
        self._splitter = LineSplitter(Command.max_bytes)
        self._unwritten = b""
        """The rest of a line of which the program's input has room for a part only."""
        self.has_ended = False
        """Its output has ended: nothing comes from it any more."""

    @property
    def has_unread_input(self) -> bool:
        """Whether the program has not read everything that it was sent."""
        if self._unwritten:
            return True
        room = fcntl.ioctl(self._in.fileno(), termios.FIONREAD, b"\0\0\0\0")
        return bool(struct.unpack("i", room)[0])

    def send(self, line: bytes) -> None:
        """Send a line; what its input has no room for is sent by `receive`."""
        self._unwritten += line + b"\n"
        self._write()

    def receive(self, timeout: float) -> list[Line]:
        """The next lines of its output, waiting up to `timeout` s for anything to do; empty if there are none yet."""
        if self.has_ended:
            return []
        waited = select.poll()
        waited.register(self._out, select.POLLIN)
        if self._unwritten:
            waited.register(self._in, select.POLLOUT)
        waited.poll(max(0.0, timeout) * 1e3)
        self._write()
        try:
            data = os.read(self._out.fileno(), _CHUNK)
        except BlockingIOError:
            return []
        if not data:
            self.has_ended = True
            return self._splitter.feed(b"\n")  # a last line without a line break
        return self._splitter.feed(data)

    def ending(self) -> str:
        """How the program ended whose output has ended: `ended with status 3`."""
        select.poll().poll(PROGRAM_ENDS_S * 1e3)
        try:
            return ending(self._popen.wait(PROGRAM_ENDS_S))
        except subprocess.TimeoutExpired:
            return "closed its standard output"

    def close(self) -> None:
        """End the program: its input ends; if that does not suffice, SIGTERM, then SIGKILL."""
        with suppress(OSError):
            self._in.close()
        for number in (None, signal.SIGTERM, signal.SIGKILL):
            with suppress(subprocess.TimeoutExpired, PermissionError):  # another user's ends with its input
                if number is not None:
                    self._popen.send_signal(number)
                self._popen.wait(PROGRAM_ENDS_S if number is not signal.SIGKILL else None)
                break
        self._out.close()
        self.has_ended = True

    def _write(self) -> None:
        if not self._unwritten:
            return
        try:
            self._unwritten = self._unwritten[os.write(self._in.fileno(), self._unwritten) :]
        except BlockingIOError:
            return
        except BrokenPipeError:
            self._unwritten = b""  # it has closed its input; the end of its output reports what became of it
