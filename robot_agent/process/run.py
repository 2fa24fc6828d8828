"""One robot's process: bus, brain, run. Importing it loads what every robot needs, and no brain."""

import signal

from robot_agent.loading.brain_reload import BrainReload
from robot_agent.process.brain_runner import BrainRunner
from robot_agent.process.breakpoints import skip_breakpoints
from robot_agent.process.claim import Membership
from robot_agent.process.robot_code import end_robot, start_robot
from robot_agent.process.runner import serve
from robot_agent.process.settings import AgentSettings
from robot_agent.process.stdio.program_runner import ProgramRunner
from robot_agent.sdk.contract import Brain, Briefing
from runtime.bus.zenoh.bus import ZenohBus, open_client
from runtime.bus.zenoh.waiting_client import open_when_there
from runtime.process.clock import WallClock
from runtime.process.process_log import configure_log, log_line
from runtime.process.scheduling import use_batch_scheduling
from schemas.config.match_config import LOCKSTEP
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup


def run(settings: AgentSettings) -> int:
    """Run one robot; exit status 0: the match is over or the process was ended; others as in `serve`.

    Raises:
        TouchlineError: no host answers, the brain cannot be made, or a program is to be reloaded.
    """
    if settings.reload and settings.stdio:
        raise TouchlineError("--reload is for brains in Python, --stdio starts a program; leave one of them out")
    configure_log("agent", settings.log_format, settings.robot)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # a polite end, as from a keyboard
    clock = WallClock()
    skipped = skip_breakpoints(settings, clock)

    def connect(patience: float) -> ZenohBus:
        return open_client(settings.match, clock, settings.connect, patience, settings.credentials, any_match=True)

    brain: Brain | None = None
    try:
        client = open_when_there(connect, clock, settings.patience, log_line)
        assert client is not None  # a wait that nothing stops
        with client as bus:

            def build(setup: Setup) -> Brain:
                nonlocal brain
                end_robot(brain)
                use_batch_scheduling(setup.pace == LOCKSTEP)
                if skipped is not None:
                    skipped.tick_s = setup.time.tick
                briefing = Briefing.of(settings.robot, setup)
                folders = settings.brain_folder, settings.launch_folder
                brain = start_robot(settings.brain, settings.stdio, briefing, *folders)
                return brain

            membership = Membership(bus, settings.robot, settings.launch_token, settings.match, settings.side)
            runner_class = ProgramRunner if settings.stdio else BrainRunner
            reload = BrainReload(settings.robot, build) if settings.reload else None
            return serve(bus, build, settings.robot, settings.patience, membership, runner_class, reload)
    except KeyboardInterrupt:
        return 0
    finally:
        end_robot(brain)
