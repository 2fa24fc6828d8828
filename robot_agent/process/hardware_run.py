"""The process of one robot on its own hardware, with a host or without."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from robot_agent.hardware.contract import Hardware
from robot_agent.hardware.guard import HardwareError, HardwareGuard
from robot_agent.hardware.settings import hardware_settings
from robot_agent.loading.brain_error import RobotError
from robot_agent.loading.brain_loader import load_object
from robot_agent.loading.user_code import sentence_of
from robot_agent.process.hardware_runner import RunnerWithoutHost
from robot_agent.process.settings import FIRST_SIGHT_FAILED, AgentSettings, BodyOptions
from robot_agent.process.timing import IDLE_S
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Bus
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.clock import Clock
from runtime.process.process_log import Level, log_line
from schemas.errors import TouchlineError
from schemas.messages.hardware import HardwareState
from schemas.messages.setup import Setup

SHIPPED = {
    "dummy": "robot_agent.hardware.dummy:Dummy",
    "simulated": "robot_agent.hardware.simulated.driver:Simulated",
    "replayed": "touchline.hardware.replayed:Replayed",
}
"""Names that stand for hardware that ships."""


def check_body(settings: AgentSettings) -> None:
    """Check that the options of a robot on hardware fit together.

    Raises:
        TouchlineError: one has no effect without another, or the process has several robots.
    """
    body = settings.body
    if not body.hardware and body != BodyOptions():
        raise TouchlineError("--arm, --match-file, --listen and --insecure are for hardware; name it with --hardware")
    if body.hardware and settings.mates:
        raise TouchlineError(f"{settings.robot}: a process has the hardware of one robot; start one for each robot")
    body.check(has_credentials=settings.credentials is not None)


@contextmanager
def guarded_hardware(settings: AgentSettings, setup: Setup, clock: Clock) -> Iterator[HardwareGuard]:
    """The hardware of a robot, configured, watched by a thread, and stopped at the end.

    Raises:
        TouchlineError: there is no such class, or it cannot be built.
        HardwareError: it cannot be configured or activated.
    """
    chosen, model = hardware_settings(settings.body.hardware), setup.model_of(settings.robot)
    spec = SHIPPED.get(chosen.hardware, chosen.hardware)
    said = f'hardware is "{chosen.hardware}"'
    if ":" not in spec:
        raise TouchlineError(f"{said}; name a class, module:Class, a file *.toml, or {', '.join(SHIPPED)}")
    build, name = load_object(said, spec, settings.brain_folder, settings.launch_folder)
    try:
        hardware: Hardware = build(model, **chosen.options)
    except Exception as error:
        fault = f"{name}(model, …) raised {sentence_of(error)}; check its options"
        raise TouchlineError(f"{said}; {error if isinstance(error, TouchlineError) else fault}") from error
    guard = HardwareGuard(hardware, chosen, model, settings.robot, clock, armed=settings.body.arm)
    is_over = threading.Event()
    watch = threading.Thread(target=_watch, args=(guard, setup.time.tick, is_over), daemon=True)
    try:
        guard.start()
        watch.start()
        yield guard
    except KeyboardInterrupt:
        if guard.state is HardwareState.ERROR:
            raise HardwareError(guard.health().reason) from None
        raise
    finally:
        is_over.set()
        guard.stop()


def _watch(guard: HardwareGuard, period: float, is_over: threading.Event) -> None:
    """Watch hardware from a thread of its own; ends the process where a call does not return."""
    while not is_over.wait(period):
        if not guard.watch():
            os.kill(os.getpid(), signal.SIGTERM)
            if not is_over.wait(IDLE_S):
                os._exit(1)  # its devices are closed by the kernel, and stop by themselves
            return


def open_free_network(settings: AgentSettings, clock: Clock, patience: float) -> ZenohBus:
    """The network of robots without a host: this robot waits for the others, or connects to one of them.

    Raises:
        TouchlineError: as `WithoutHost.open`.
    """
    match = settings.match or settings.body.setup().match
    bus = settings.body.open(match, settings.connect, clock, patience)
    log_line(f"{settings.robot}: match {match} without a host, at {bus.endpoint}")
    return bus


def serve_without_host(bus: Bus, setup: Setup, settings: AgentSettings, build: Callable[[Setup], Brain]) -> int:
    """Run a robot on hardware without a host, until the process is ended; the exit status.

    Raises:
        TouchlineError: brain or hardware cannot be built.
        HardwareError: the hardware fails.
    """
    brain = build(setup)
    with guarded_hardware(settings, setup, bus.clock) as guard:
        runner = RunnerWithoutHost(guard, setup, bus, brain, settings.robot)
        while True:
            sight = runner.next_sight(None)
            if sight is None:
                continue
            try:
                runner.answer(sight)
            except RobotError as error:
                log_line(error.report(), Level.ERROR, tick=sight.tick)
                return 1 if runner.answered else FIRST_SIGHT_FAILED
