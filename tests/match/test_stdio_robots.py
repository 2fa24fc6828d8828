"""Matches with programs of lines that crash, are silent or write garbage: each is named, none is fatal."""

import re
import sys
from pathlib import Path

import pytest

from support.isolated_match import IsolatedMatch, needs_bubblewrap

pytestmark = pytest.mark.processes

PROGRAM = """
import json, os, signal, sys
briefing = json.loads(sys.stdin.readline())
for line in sys.stdin:
    sight = json.loads(line)
    tick = sight["tick"]
{body}
    print(json.dumps({{"answers_tick": tick}}), flush=True)
"""


class StdioMatch(IsolatedMatch):
    """A match whose cyan is a program of lines with this body of its loop."""

    def __init__(
        self, folder: Path, body: str, *, top: str = "", duration: float = 4.0, patience: float = 60.0
    ) -> None:
        super().__init__(folder, "    pass", top=top)
        (folder / "robot.py").write_text(PROGRAM.format(body="\n".join(f"    {line}" for line in body.splitlines())))
        file = folder / "match.toml"
        text = file.read_text().replace('brain = "cyan_team:Brain"', f'stdio = ["{sys.executable}", "robot.py"]')
        text = text.replace("duration = 4.0", f"duration = {duration}")
        file.write_text(text.replace("answer = 60.0", f"answer = {patience}"))


def test_a_robot_whose_program_writes_garbage_and_crashes_is_started_again_and_both_are_named(tmp_path: Path) -> None:
    garbage = "if tick < 60:\n    print('ball?', sight['ball'] is not None)\n    print('{\"answers_tick\": NaN}')\n"
    crash = "if tick == 60:\n    os.kill(os.getpid(), signal.SIGSEGV)"
    played = StdioMatch(tmp_path, garbage + crash, duration=40.0).play()  # while the launcher looks at its processes
    assert played.status == 1
    assert re.search(r"does not depend on its seed alone: sights without an answer: cyan1 \d+\n", played.printed)
    assert "cyan1 ended with status 1; started again (1 of 3)" in played.printed
    assert "robot.py` was ended by SIGSEGV at tick 60" in played.printed
    log = played.log("cyan1")
    assert "cyan1 sends messages that are no commands" in played.printed
    assert "cyan1: the program wrote 'ball? " in log
    assert "answers_tick is nan" in log
    assert "60 lines that were no JSON object, " in log


@needs_bubblewrap()
def test_a_program_is_confined_as_its_agent_is(open_folder: Path) -> None:
    body = "if tick == 0: print(os.getcwd(), os.getpid() < 20, os.path.exists('/root'), file=sys.stderr, flush=True)"
    played = StdioMatch(open_folder, body, top='isolate = "bubblewrap"').play()
    assert played.is_whole()
    assert f"{played.run / 'cyan1'} True False" in played.log("cyan1")
