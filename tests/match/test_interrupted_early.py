"""Ctrl-C while a match is still being prepared: at any import, in every process of the terminal's process group."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

INTERRUPTING = """
import os, signal, sys

class Finder:
    def find_spec(name, path=None, target=None):
        if name == {module!r}:
            os.killpg(os.getsid(0), signal.SIGINT)
        return None

sys.meta_path.insert(0, Finder)
"""
"""As `sitecustomize`, sends SIGINT when a module is imported, to the process group that Ctrl-C reaches: the launcher's,
which leads the session. Robots have groups of their own, and no variables but those of a list."""
MODULES = {
    "the simulation, to check the match file": "sim_host.match.live_parameters",
    "the check of the brains, in its process": "robot_agent.loading.build_check",
    "the launch": "touchline.launch.match_run",
    "the robots, in the process that they are forked from": "robot_agent.process.run",
}


@pytest.mark.parametrize(
    "moment", [pytest.param(moment, marks=pytest.mark.long if "simulation" in moment else ()) for moment in MODULES]
)
def test_ctrl_c_during_the_start_ends_the_match_without_a_traceback(moment: str, tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text(INTERRUPTING.format(module=MODULES[moment]))
    path = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])])
    cup = tmp_path / "cup"
    cup.mkdir()
    done = subprocess.run(
        [sys.executable, "-m", "touchline", "match", "--listen", "tcp/127.0.0.1:0"],
        cwd=cup,
        env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        timeout=120,
        check=False,
    )
    assert done.returncode in (-signal.SIGINT, 128 + signal.SIGINT), done.stdout
    assert "Traceback" not in done.stdout
    assert len(done.stdout.splitlines()) <= 3, done.stdout
