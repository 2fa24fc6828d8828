"""`python -m robot_agent.loading.build_check --settings FILE`: builds a team's brains once, as in a match.

It runs before a match is launched, in a process of its own: a brain may print, take ports, or end its process.
"""

import os
import sys
from pathlib import Path
from typing import NoReturn

from robot_agent.loading.brain_loader import load_brain
from robot_agent.sdk.contract import Briefing
from runtime.process.settings_file import run_process
from schemas.config.match_config import MatchConfig
from schemas.config.settings import Settings
from schemas.messages.setup import Setup
from schemas.side import Side


class BuildCheckSettings(Settings):
    """The team whose brains are built."""

    config: MatchConfig
    """The match."""
    side: Side
    """The side of the team."""
    brain_folder: Path | None = None
    """Folder in which the module is looked for before the current directory."""
    launch_folder: Path | None = None
    """Folder in which it is looked for after that; by default the current directory."""


def run(settings: BuildCheckSettings) -> int:
    """Build the brain of each robot of the team once; the exit status of the process.

    Raises:
        TouchlineError: a brain cannot be built.
    """
    config = settings.config
    setup = Setup.of(config, config.load_profile(), config.load_rule_book())
    for robot in config.robots(settings.side):
        os.environ["TOUCHLINE_ROBOT"] = robot
        brain = config.team(settings.side).brain or ""
        load_brain(brain, Briefing.of(robot, setup), settings.brain_folder, settings.launch_folder)
    return 0


def _end(status: int) -> NoReturn:
    """End this process at once: a brain may have started a thread that does not end."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


if __name__ == "__main__":
    _end(run_process("robot_agent.loading.build_check", BuildCheckSettings, run))
