"""A match that is played from a user's folder, whose files have names that modules of Python and Touchline have."""

import sys
from pathlib import Path

import pytest

from support.brisk import BRISK

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

NAMES = ("schemas", "robot_agent", "random", "socket", "numpy", "zenoh", "mcap", "starlette")
BRAIN = """
from touchline import Command
from helper import ANSWER

class Still:
    def __init__(self, briefing):
        self.robot = briefing.robot

    def act(self, sight):
        return Command(answers_tick=sight.tick + ANSWER)
"""
MATCH = f"""
duration = 0.2
rules = "{BRISK}"
[teams.cyan]
brain = "still:Still"
size = 1
[teams.magenta]
size = 1
"""


@pytest.fixture(scope="module")
def cup(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a match file, a brain, and modules that must not be loaded."""
    folder = tmp_path_factory.mktemp("cup")
    (folder / "still.py").write_text(BRAIN)
    (folder / "helper.py").write_text("ANSWER = 0\n")
    (folder / "match.toml").write_text(MATCH)
    for name in NAMES:
        (folder / f"{name}.py").write_text(f"raise RuntimeError('the user has a file {name}.py')\n")
    return folder


def test_no_file_of_the_users_folder_hides_a_module_of_the_matchs_processes(start, cup):
    program = start("touchline", "match", "match.toml", "--web", "--listen", "tcp/127.0.0.1:0", "--web-port", "0",
                    "--pace", "lockstep", folder=cup, PYTHONPATH=_with_current_directory())  # fmt: skip
    assert program.status() == 0, program.err + program.out
    logs = "".join(log.read_text() for log in cup.glob("runs/*/*.log"))
    assert "the user has a file" not in logs + program.err + program.out


def _with_current_directory() -> str:
    """A PYTHONPATH with an empty entry, which means the current directory; `PYTHONPATH=$PYTHONPATH:/lib` makes one."""
    return ":".join(["", *(entry for entry in sys.path if entry)])
