"""Network namespaces of a test: machines on a switch that is in a namespace of its own, away from the real network.

Requires Linux, iproute2 and the right to make namespaces; without them `network` skips the test.

    with network("host", "cyan") as net:
        host = net.run("host", ["touchline", "host", "--listen", f"tcp/{net.address('host')}:7447"])
        net.cut("cyan")  # the cable of cyan
"""

import ctypes
import itertools
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, TypeVar

import pytest

from support import link_emulator
from support.link_emulator import LinkConditions

IPV4, IPV6 = "10.77.0", "fd77:7447"
"""Prefixes of the machines' addresses: 10.77.0.1 and fd77:7447::1 are those of the first."""
INTERFACE = "eth0"
"""The interface of a machine, as seen in its namespace."""
_NAME = re.compile(r"tl-(\d+)-\d+-[\w-]+")
_END_S = 5.0
_CLONE_NEWNET = 0x40000000
_numbers = itertools.count()
_T = TypeVar("_T")


class Network:
    """Machines by name, joined by a switch; every machine can reach every other one."""

    def __init__(self, names: Sequence[str]) -> None:
        self.names = list(names)
        self._prefix = f"tl-{os.getpid()}-{next(_numbers)}"
        self._switch = f"{self._prefix}-switch"
        self._programs: list[subprocess.Popen[bytes]] = []
        self._emulators: dict[str, subprocess.Popen[bytes]] = {}

    def namespace(self, name: str) -> str:
        """The namespace of a machine, as `ip netns` lists it."""
        return f"{self._prefix}-{name}"

    def address(self, name: str) -> str:
        """The IPv4 address of a machine."""
        return f"{IPV4}.{self.names.index(name) + 1}"

    def address6(self, name: str) -> str:
        """The IPv6 address of a machine, without brackets."""
        return f"{IPV6}::{self.names.index(name) + 1:x}"

    def command(self, name: str, command: Sequence[str]) -> list[str]:
        """The command that runs `command` on a machine, with the same process id."""
        return ["ip", "netns", "exec", self.namespace(name), *command]

    def run(self, name: str, command: Sequence[str], **options: Any) -> "subprocess.Popen[bytes]":
        """Start a process on a machine; `options` are those of `subprocess.Popen`. It is killed with the network."""
        program = subprocess.Popen(self.command(name, command), **options)
        self._programs.append(program)
        return program

    def inside(self, name: str, call: Callable[[], _T]) -> _T:
        """Call a function in a thread on a machine: sockets that it makes stay there, and work in all threads."""
        results: list[_T] = []
        errors: list[BaseException] = []

        def enter() -> None:
            try:
                with Path(f"/run/netns/{self.namespace(name)}").open("rb") as file:
                    if ctypes.CDLL(None, use_errno=True).setns(file.fileno(), _CLONE_NEWNET):
                        raise OSError(ctypes.get_errno(), "setns")
                results.append(call())
            except BaseException as error:
                errors.append(error)

        thread = threading.Thread(target=enter)
        thread.start()
        thread.join()
        if errors:
            raise errors[0]
        return results[0]

    def connect(self, name: str, address: str, port: int) -> socket.socket:
        """A TCP connection from a machine."""
        return self.inside(name, lambda: socket.create_connection((address, port)))

    def cut(self, name: str) -> None:
        """Unplug a machine's cable: its interface and the port of the switch have no carrier; addresses stay."""
        self._ip(f"link set dev {_port(name)} down")

    def restore(self, name: str) -> None:
        """Plug it in again."""
        self._ip(f"link set dev {_port(name)} up")

    def impair(self, name: str, conditions: LinkConditions) -> None:
        """Give the link of a machine these conditions, in both directions, until the next call for it.

        With `is_cut`, frames vanish on the way, and both ends keep their carrier.
        """
        emulator = self._emulators.get(name) or self._emulate(name)
        assert emulator.stdin is not None
        emulator.stdin.write(conditions.line())
        emulator.stdin.flush()

    def open(self) -> None:
        """Make namespaces and cables."""
        for name in ("switch", *self.names):
            _run(["ip", "netns", "add", self.namespace(name)])
        lines = ["link set dev lo up", "link add br0 type bridge forward_delay 0 mcast_snooping 0"]
        lines.append("link set dev br0 up")
        for name in self.names:
            lines.append(f"link add {_port(name)} type veth peer name {INTERFACE} netns {self.namespace(name)}")
            lines.append(f"link set dev {_port(name)} master br0 up")
        self._ip(*lines)
        for name in self.names:
            _run(self.command(name, ["sh", "-c", "echo 1 > /proc/sys/net/ipv6/conf/all/keep_addr_on_down || true"]))
            self._ip(
                "link set dev lo up",
                f"addr add {self.address(name)}/24 dev {INTERFACE}",
                f"addr add {self.address6(name)}/64 dev {INTERFACE} nodad",
                f"link set dev {INTERFACE} up",
                namespace=self.namespace(name),
            )

    def close(self) -> None:
        """End the machines' processes, and remove the namespaces."""
        for emulator in self._emulators.values():
            assert emulator.stdin is not None
            emulator.stdin.close()
            emulator.wait(_END_S)
        for name in ("switch", *self.names):
            _remove(self.namespace(name))
        for program in self._programs:
            program.wait(_END_S)
            for pipe in (program.stdin, program.stdout, program.stderr):
                if pipe is not None:
                    pipe.close()

    def _emulate(self, name: str) -> "subprocess.Popen[bytes]":
        """Put an emulator between the port of a machine and the switch."""
        number = self.names.index(name)
        near, far, bridge = f"near{number}", f"far{number}", f"br{number + 1}"
        self._ip(
            f"tuntap add dev {near} mode tap",
            f"tuntap add dev {far} mode tap",
            f"link add {bridge} type bridge forward_delay 0 mcast_snooping 0",
            f"link set dev {bridge} up",
        )
        program = [sys.executable, link_emulator.__file__, near, far]
        emulator = subprocess.Popen(
            ["ip", "netns", "exec", self._switch, *program], stdin=subprocess.PIPE, start_new_session=True
        )
        self._emulators[name] = emulator
        self._ip(
            f"link set dev {near} master {bridge} up",
            f"link set dev {far} master br0 up",
            f"link set dev {_port(name)} master {bridge}",
        )
        return emulator

    def _ip(self, *lines: str, namespace: str | None = None) -> None:
        _run(["ip", "-n", namespace or self._switch, "-batch", "-"], "\n".join(lines))


def _port(name: str) -> str:
    return f"to-{name}"[:15]


def _run(command: Sequence[str], text: str = "") -> None:
    done = subprocess.run(command, input=text.encode(), capture_output=True, check=False)
    if done.returncode:
        raise OSError(f"{' '.join(command)}: {done.stderr.decode().strip()}; {text}")


def _remove(namespace: str) -> None:
    """Kill the processes in a namespace of a test, and remove it."""
    listed = subprocess.run(["ip", "netns", "pids", namespace], capture_output=True, text=True, check=False)
    for pid in listed.stdout.split():
        with suppress(ProcessLookupError):
            os.kill(int(pid), signal.SIGKILL)
    subprocess.run(["ip", "netns", "del", namespace], capture_output=True, check=False)


def _remove_leftovers() -> None:
    """Remove the namespaces of test processes that were killed."""
    folder = Path("/run/netns")
    for entry in folder.iterdir() if folder.exists() else ():
        found = _NAME.fullmatch(entry.name)
        if found and not Path(f"/proc/{found[1]}").exists():
            _remove(entry.name)


def why_not() -> str | None:
    """Why this machine cannot make network namespaces; None if it can."""
    if not sys.platform.startswith("linux"):
        return "network namespaces are a feature of Linux"
    if shutil.which("ip") is None:
        return "no `ip`; apt-get install iproute2"
    probe = f"tl-{os.getpid()}-{next(_numbers)}-probe"
    made = subprocess.run(["ip", "netns", "add", probe], capture_output=True, text=True, check=False)
    if made.returncode:
        return f"network namespaces are not permitted: {made.stderr.strip()}"
    _remove(probe)
    return None


@contextmanager
def network(*names: str) -> Iterator[Network]:
    """Machines with these names (at most 11 letters each), until the block ends.

    Skips the test where namespaces are not permitted, unless the environment sets TOUCHLINE_NAMESPACES=needed.
    """
    reason = why_not()
    if reason is not None:
        assert os.environ.get("TOUCHLINE_NAMESPACES") != "needed", reason
        pytest.skip(reason)
    _remove_leftovers()
    net = Network(names)
    try:
        net.open()
        yield net
    finally:
        net.close()
