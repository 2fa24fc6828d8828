"""The process of one robot, or of a team: bus, brains, run. Importing it loads what every robot needs, and no brain."""

import signal
from contextlib import ExitStack
from functools import partial

from robot_agent.hardware.guard import HardwareError
from robot_agent.loading.brain_reload import BrainReload
from robot_agent.process.brain_runner import BrainRunner
from robot_agent.process.breakpoints import skip_breakpoints
from robot_agent.process.claim import Membership
from robot_agent.process.hardware_run import check_body, guarded_hardware, open_free_network, serve_without_host
from robot_agent.process.hardware_runner import HardwareRunner
from robot_agent.process.robot_code import end_robot, start_robot
from robot_agent.process.runner import MakeRunner, Member, Runner, serve
from robot_agent.process.settings import AgentSettings
from robot_agent.process.stdio.program_runner import ProgramRunner
from robot_agent.process.team_process import serve_team
from robot_agent.sdk.contract import Brain, Briefing
from runtime.bus.contract import Bus, Subscription
from runtime.bus.zenoh.bus import ZenohBus, open_client
from runtime.bus.zenoh.waiting_client import open_when_there
from runtime.process.clock import WallClock
from runtime.process.process_log import Level, configure_log, log_line
from runtime.process.scheduling import use_batch_scheduling
from schemas.config.match_config import LOCKSTEP
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup


def run(settings: AgentSettings) -> int:
    """Run one robot, or several; exit status 0: the match is over or the process was ended; others as in `serve`.

    Raises:
        TouchlineError: no host answers, the brain cannot be made, or a program is to be reloaded.
    """
    if settings.reload and settings.stdio:
        raise TouchlineError("--reload is for brains in Python, --stdio starts a program; leave one of them out")
    check_body(settings)
    configure_log("agent", settings.log_format, settings.robot)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # a polite end, as from a keyboard
    clock = WallClock()
    skipped = skip_breakpoints(settings, clock)
    brains: dict[str, Brain] = {}
    setups: dict[str, Setup] = {}

    def connect(patience: float) -> ZenohBus:
        if settings.body.match_file is not None:
            return open_free_network(settings, clock, patience)
        return open_client(settings.match, clock, settings.connect, patience, settings.credentials, any_match=True)

    def build(robot: str, setup: Setup) -> Brain:
        end_robot(brains.pop(robot, None))
        use_batch_scheduling(setup.pace == LOCKSTEP)
        if skipped is not None:
            skipped.tick_s = setup.time.tick
        folders = settings.brain_folder, settings.launch_folder
        setups[robot] = setup
        brains[robot] = start_robot(settings.brain, settings.stdio, Briefing.of(robot, setup), *folders)
        return brains[robot]

    def member(bus: Bus, robot: str, make_runner: MakeRunner) -> Member:
        membership = Membership(bus, robot, settings.launch_token, settings.match, settings.side)
        reload = BrainReload(robot, partial(build, robot)) if settings.reload else None
        return Member(bus, partial(build, robot), robot, settings.patience, membership, make_runner, reload)

    try:
        client = open_when_there(connect, clock, settings.patience, log_line)
        assert client is not None  # a wait that nothing stops
        with client as bus, ExitStack() as hardware:

            def on_hardware(bus: Bus, brain: Brain, robot: str) -> Runner:
                guard = hardware.enter_context(guarded_hardware(settings, setups[robot], clock))
                return HardwareRunner(guard, setups[robot], bus, brain, robot)

            if settings.mates:

                def mate(robot: str, sights: Subscription) -> Member:
                    return member(bus, robot, partial(BrainRunner, sights=sights))

                return serve_team(bus, (settings.robot, *settings.mates), mate)
            if settings.body.match_file is not None:
                return serve_without_host(bus, settings.body.setup(), settings, partial(build, settings.robot))
            alone = on_hardware if settings.body.hardware else ProgramRunner if settings.stdio else BrainRunner
            return serve(bus, member(bus, settings.robot, alone))
    except HardwareError as error:
        log_line(f"{settings.robot}: {error}", Level.ERROR)
        return 1
    except KeyboardInterrupt:
        return 0
    finally:
        for brain in brains.values():
            end_robot(brain)
