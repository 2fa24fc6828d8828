"""Brains that use more of the machine than their limits allow, in a real match."""

from pathlib import Path

import pytest

from support.isolated_match import IsolatedMatch
from support.process_story import is_running

pytestmark = pytest.mark.processes


def test_a_robot_over_a_limit_is_named_one_that_stays_after_sigterm_is_ended_and_the_match_goes_on(
    tmp_path: Path,
) -> None:
    brain = (
        "    def begin(self):\n        if self.robot == 'cyan1':\n            self.all = bytearray(10_000_000_000)\n"
        "        signal.signal(signal.SIGTERM, signal.SIG_IGN)\n        Path('pid').write_text(str(os.getpid()))"
    )
    played = IsolatedMatch(tmp_path, brain, limits="memory = 1.5", size=2).play()
    assert played.is_whole(), played.printed
    assert played.line("limit reached").startswith(
        "  cyan1: limit reached: it used more than 1.5 GB of memory; raise [limits] memory"
    )
    assert not is_running(int((played.run / "cyan2" / "pid").read_text()))
