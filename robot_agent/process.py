"""One robot's process: bus, brain, run. Importing it loads what every robot needs, and no brain."""

import signal
from types import FrameType

from robot_agent.contract import Brain, Briefing, load_brain
from robot_agent.runner import serve
from robot_agent.settings import AgentSettings
from schemas.bus.zenoh.bus import open_client
from schemas.config.match_config import LOCKSTEP
from schemas.messages.setup import Setup
from schemas.process.clock import WallClock
from schemas.process.scheduling import use_batch_scheduling


def run(settings: AgentSettings) -> int:
    """Run one robot; exit status 0: the match is over or the process was ended, 1: the brain raised.

    Raises:
        TouchlineError: no host answers, or the brain cannot be made.
    """
    signal.signal(signal.SIGTERM, _end)
    try:
        with open_client(settings.match, WallClock(), settings.connect, settings.patience) as bus:

            def build(setup: Setup) -> Brain:
                use_batch_scheduling(setup.pace == LOCKSTEP)
                return load_brain(settings.brain, Briefing.of(settings.robot, setup))

            return serve(bus, build, settings.robot, settings.patience, settings.launch_token)
    except KeyboardInterrupt:
        return 0


def _end(number: int, frame: FrameType | None) -> None:
    """A polite end, from a supervisor as from a keyboard."""
    del number, frame
    raise KeyboardInterrupt
