"""A port whose links lead to another one, and can be blocked or cut."""

import socket
import threading
from collections.abc import Callable
from contextlib import suppress

from support.page_gateway import SOON


class Tunnel:
    """A port that forwards to another one until it is blocked, and silently drops everything, or is cut."""

    def __init__(self, connect: int | Callable[[], socket.socket]) -> None:
        """`connect` is a port of this machine, or makes each link's other end."""
        self._connect = connect
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        self.is_cut = False
        self.left: int | None = None
        """Bytes that are still carried back; then the link breaks, once."""
        self._links: list[tuple[socket.socket, socket.socket]] = []
        self._blocked: list[socket.socket] = []
        self._threads = [threading.Thread(target=self._accept)]
        self._threads[0].start()

    def block(self) -> None:
        """All links that there are; new ones are not."""
        self._blocked += [end for link in self._links for end in link]

    @property
    def count(self) -> int:
        """Links that have been made."""
        return len(self._links)

    def cut(self) -> None:
        """Break all links that there are, and new ones at once."""
        self.is_cut = True
        for end in (end for link in self._links for end in link):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        self.cut()
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        for thread in self._threads:
            thread.join(SOON)
        for end in (self._listener, *(end for link in self._links for end in link)):
            end.close()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                try:
                    if self.is_cut:
                        raise ConnectionRefusedError
                    far = self._far_end()
                except OSError:  # nobody listens there yet
                    near.close()
                    continue
                self._links.append((near, far))
                for ends in ((near, far, False), (far, near, True)):
                    self._threads.append(threading.Thread(target=self._pump, args=ends))
                    self._threads[-1].start()

    def _far_end(self) -> socket.socket:
        if isinstance(self._connect, int):
            return socket.create_connection(("127.0.0.1", self._connect))
        return self._connect()

    def _pump(self, begin: socket.socket, end: socket.socket, back: bool) -> None:
        with suppress(OSError):
            while data := begin.recv(65_536):
                if back and self.left is not None:
                    carried, self.left = data[: self.left], self.left - len(data)
                    if self.left < 0:
                        self.left = None
                        end.sendall(carried)
                        begin.shutdown(socket.SHUT_RDWR)
                        break
                if begin not in self._blocked:
                    end.sendall(data)
            if begin not in self._blocked:
                end.shutdown(socket.SHUT_WR)
