"""The commands of docs/many_matches.md for several machines, run as they stand, on a machine with the address there."""

import json
import os
import re
import signal
import subprocess
import sys
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path

import pytest

from support.cups import CUP, mini_cup, play
from support.namespaces import Network, network
from support.process_story import descendants, wait_for
from touchline.matches.cup.report import RESULT, report_of

pytestmark = [
    pytest.mark.skipif(find_spec("distributed") is None, reason='needs Dask: pip install "touchline[cluster]"'),
    pytest.mark.processes,
    pytest.mark.long,
    pytest.mark.timeout(400),
]

ROOT = Path(__file__).parents[2]
SECTION = (ROOT / "docs" / "many_matches.md").read_text("utf-8").partition("\n## Several machines\n")[2]
SCHEDULER, WORKER, TOURNAMENT, _ = re.findall(r"^```sh\n(.*?)^```$", SECTION, re.DOTALL | re.MULTILINE)[0].splitlines()
MACHINE = "lab"


class Lab:
    """A machine on which the lines are typed, in a folder with the cup file."""

    def __init__(self, net: Network, folder: Path) -> None:
        self._net, self._folder = net, folder
        self._environment = os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
        address = re.findall(r"tcp://([\d.]+):", TOURNAMENT)[0]
        net.run(MACHINE, ["ip", "addr", "add", f"{address}/32", "dev", "lo"]).wait()
        (folder / "CUP.toml").write_text(CUP)

    def type(self, line: str, said: str) -> tuple["subprocess.Popen[bytes]", Path]:
        """Begin a line; what it says is in a file of this name."""
        path = self._folder / said
        with path.open("wb") as log:
            return self._net.run(
                MACHINE, ["sh", "-c", line], cwd=self._folder, env=self._environment, stdout=log, stderr=log
            ), path


def workers(program: "subprocess.Popen[bytes]") -> list[int]:
    """The processes in which a Dask worker of this program plays."""
    return [one for one in descendants(program.pid) if b"spawn_main" in Path(f"/proc/{one}/cmdline").read_bytes()]


def test_the_cup_of_the_docs_is_played_on_dask_also_when_a_worker_is_killed(tmp_path: Path) -> None:
    with network(MACHINE) as net:
        lab = Lab(net, tmp_path)
        lab.type(SCHEDULER, "scheduler")
        worker, log = lab.type(WORKER, "worker")
        wait_for(lambda: "Registered to" in log.read_text(), "a worker that has joined")
        cup, said = lab.type(TOURNAMENT, "cup")
        wait_for(lambda: "admission" in said.read_text(), "a match that has ended")
        os.kill(workers(worker)[0], signal.SIGKILL)
        assert cup.wait(300) == 0, said.read_text()
        assert "Restarting worker" in log.read_text()
    there = json.loads((tmp_path / "runs" / "mini" / RESULT).read_text())
    assert there["complete"]
    with closing(mini_cup(tmp_path)) as run:
        assert json.loads(json.dumps(report_of(play(run, 1)))) == there


def test_without_the_variable_the_cup_says_what_is_missing(tmp_path: Path) -> None:
    with network(MACHINE) as net:
        lab = Lab(net, tmp_path)
        lab.type(SCHEDULER, "scheduler")
        lab.type(WORKER.partition(" ")[2], "worker")
        cup, said = lab.type(TOURNAMENT, "cup")
        assert cup.wait(120) == 2
        last = said.read_text().splitlines()[-1]
        assert last.startswith("touchline: the Dask worker may not start processes; start it with DASK_DISTRIBUTED__")
