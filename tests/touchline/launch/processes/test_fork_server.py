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
    reader, writer = os.pipe()
    process = SimpleNamespace(stdin=io.StringIO(), stdout=os.fdopen(reader), poll=lambda: None)
    monkeypatch.setattr(subprocess, "Popen", lambda *_, **__: process)
    server = ForkServer()
    with os.fdopen(writer, "w", buffering=1) as replies:
        for pid, status in ((7, None), (7, 0), (7, None), (8, None), (8, 3)):
            replies.write(json.dumps({"pid": pid, "status": status}) + "\n")
        assert [server.fork({}) for _ in range(3)] == [7, 7, 8]
        assert server.status(7) is None
    assert server.fork({}) is None
    assert (server.status(7), server.status(8)) == (-signal.SIGKILL, 3)
