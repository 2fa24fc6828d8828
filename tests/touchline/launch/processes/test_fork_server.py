"""What the launcher makes of the replies of the process that robots are forked from."""

import io
import json
import os
import signal
import subprocess
from types import SimpleNamespace

import pytest

from touchline.launch.processes.fork_server import ForkServer


def test_a_robot_with_the_process_id_of_one_that_has_ended_runs_until_its_server_ends(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pipes = [os.pipe() for _ in range(2)]
    readers = [os.fdopen(reader) for reader, _ in pipes]
    started: list[SimpleNamespace] = []

    def popen(*_: object, **__: object) -> SimpleNamespace:
        started.append(SimpleNamespace(stdin=io.StringIO(), stdout=readers[len(started)], wait=lambda: 0))
        return started[-1]

    monkeypatch.setattr(subprocess, "Popen", popen)
    server = ForkServer()
    with os.fdopen(pipes[1][1], "w", buffering=1) as later:
        with os.fdopen(pipes[0][1], "w", buffering=1) as replies:
            for pid, status in ((7, None), (7, 0), (7, None), (8, None), (8, 3), (None, None)):
                replies.write(json.dumps({"pid": pid, "status": status}) + "\n")
            assert [server.fork({}) for _ in range(4)] == [7, 7, 8, None]
            assert server.status(7) is None
        while server.status(7) is None:
            pass
        assert (server.status(7), server.status(8)) == (-signal.SIGKILL, 3)
        later.write(json.dumps({"pid": 9, "status": None}) + "\n")
        while len(started) == 1:  # a server that has said its last may still be there
            answer = server.fork({})
        assert answer == 9
