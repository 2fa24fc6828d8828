"""What the launcher makes of the replies of the process that robots are forked from."""

import io
import json
import os
import subprocess
from types import SimpleNamespace

import pytest

from touchline.launch.processes.fork_server import ForkServer


def test_a_robot_with_the_process_id_of_one_that_has_ended_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    reader, writer = os.pipe()
    process = SimpleNamespace(stdin=io.StringIO(), stdout=os.fdopen(reader), poll=lambda: None)
    monkeypatch.setattr(subprocess, "Popen", lambda *_, **__: process)
    server = ForkServer()
    with os.fdopen(writer, "w", buffering=1) as replies:
        replies.writelines(json.dumps({"pid": 7, "status": status}) + "\n" for status in (None, 0, None))
        replies.flush()
        assert (server.fork({}), server.fork({}), server.status(7)) == (7, 7, None)
