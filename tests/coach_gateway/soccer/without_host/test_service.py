"""The league's box, our base stations and robots on hardware, without a host."""

import asyncio
import math
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import pytest

from coach_gateway.match.live import LiveMatch
from coach_gateway.soccer.refbox.client import BoxAddress, RefBoxClient
from coach_gateway.soccer.without_host.service import ServiceWithoutHost
from robot_agent.hardware.dummy import Dummy
from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from robot_agent.process.hardware_runner import RunnerWithoutHost
from runtime.process.clock import WallClock
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, OffField, Phase, TeamPhase
from schemas.topics import ACTION, HEALTH, STATE
from support.gateway_bench import Bench, until
from support.in_process_bus import SharedState
from support.messages import make_setup
from support.referee_box import CYAN_AT, MAGENTA_AT, Box
from support.stepped_clock import SteppedClock

pytestmark = pytest.mark.anyio
SETUP = make_setup(**{"referee.mode": "manual"})


class Circling:
    """Drives around a circle of 1 m whenever the game runs."""

    def act(self, sight: Sight) -> Command:
        drive = Drive(vx=1.0, omega=1.0) if sight.game.running else Drive()
        return Command(answers_tick=sight.tick, drive=drive)


class Robot:
    """cyan2 on ideal hardware; it steps the clock of the lab."""

    def __init__(self, medium: SharedState) -> None:
        self.clock = SteppedClock()
        model = SETUP.model_of("cyan2")
        self.hardware = Dummy(model, start=(-2.0, 0.5, 0.0))
        guard = HardwareGuard(self.hardware, HardwareSettings(hardware="dummy"), model, "cyan2", self.clock, armed=True)
        guard.start()
        self.runner = RunnerWithoutHost(guard, SETUP, medium.open_bus(SETUP.match, self.clock), Circling(), "cyan2")
        self.sight = None

    async def serve(self, stop: asyncio.Event) -> None:
        while not stop.is_set():
            self.sight = self.runner.next_sight(None)
            if self.sight is not None:
                self.runner.answer(self.sight)
            else:
                self.runner.guard.watch()
            await asyncio.sleep(0.001)

    @property
    def speed(self) -> float:
        """What the motors were last told, in m/s."""
        drive = self.hardware.drive or Drive()
        return math.hypot(drive.vx, drive.vy)

    def sees(self, phase: TeamPhase, *, running: bool) -> bool:
        return self.sight is not None and (self.sight.game.phase, self.sight.game.running) == (phase, running)


@asynccontextmanager
async def lab() -> AsyncIterator[tuple[Bench, Box, Robot]]:
    """A box of the league, cyan's base station at it, and a robot; no host."""
    medium = SharedState()
    bench = Bench(None, LiveMatch(medium.open_bus(SETUP.match, WallClock())))
    robot = bench.stage = Robot(medium)
    box = Box()
    station = RefBoxClient(bench.live, BoxAddress(Side.CYAN, "127.0.0.1", await box.open()), bench.logged.append)
    try:
        bench.start(robot)
        await until(lambda: robot.sees(TeamPhase.STOPPED, running=False), "no game without news of it")
        for one in (ServiceWithoutHost(medium.open_bus(SETUP.match, robot.clock), SETUP), bench.live, station):
            bench.start(one)
        await until(lambda: box.links and bench.live.state is not None and bench.live.state.refbox, "the box")
        yield bench, box, robot
    finally:
        await bench.end()
        await box.close()


async def test_a_robot_on_hardware_plays_and_stops_by_the_leagues_box() -> None:
    async with lab() as (bench, box, robot):
        await until(lambda: robot.sees(TeamPhase.PRE_GAME, running=False), "the news")
        box.say("KICKOFF", CYAN_AT)
        await until(lambda: robot.sees(TeamPhase.OUR_KICK_OFF, running=False), "the kick-off")
        box.say("FIRST_HALF")
        box.say("START")
        await until(lambda: robot.sees(TeamPhase.OUR_KICK_OFF, running=True), "START")
        box.say("STOP")
        await until(lambda: robot.sees(TeamPhase.STOPPED, running=False), "STOP")
        box.say("START")
        await until(lambda: robot.sees(TeamPhase.PLAY, running=True) and robot.speed > 0.5, "play")
        box.say("STOP")
        await until(lambda: robot.sees(TeamPhase.STOPPED, running=False) and robot.speed < 0.05, "rest")
        box.say("GOAL", MAGENTA_AT)
        box.say("THROWIN", MAGENTA_AT)
        await until(lambda: robot.sees(TeamPhase.THEIR_THROW_IN, running=False), "the throw-in")
        assert robot.sight.game.their_score == 1
        assert not any("refused" in line for line in bench.logged), bench.logged


async def test_a_whole_match_by_the_box_need_not_wait_between_its_commands() -> None:
    async with lab() as (bench, box, robot):
        box.say("KICKOFF", CYAN_AT)
        for command in ("FIRST_HALF", "START", "STOP", "HALF_TIME", "SECOND_HALF"):
            box.say(command)
        box.say("KICKOFF", MAGENTA_AT)
        box.say("START")
        await until(lambda: bench.live.state.half == 2 and bench.live.state.running, "the second half")
        assert bench.live.state.cyan_attacks == -1
        await until(lambda: robot.sight.game.half == 2, "the same on the robot")
        assert robot.sight.self.x > 0.0  # at −2 m in the field frame: the team's own axes have turned with the ends
        box.say("STOP")
        box.say("END_GAME")
        await until(lambda: bench.live.state.phase is Phase.FULL_TIME, "the end")


async def test_a_robot_that_is_off_the_field_rests_until_it_is_back() -> None:
    async with lab() as (bench, box, robot):
        box.say("START")
        await until(lambda: robot.speed > 0.5, "play")
        box.say("REPAIR", CYAN_AT, robotID=2)
        await until(lambda: robot.sight is None and robot.speed < 0.05, "rest")
        assert bench.live.state.robots["cyan2"].off_field is OffField.REPAIR
        box.say("REPAIR_END", CYAN_AT, robotID=2)
        await until(lambda: robot.sight is not None and robot.speed > 0.5, "its return")


async def test_while_the_box_is_connected_others_may_only_stop_and_afterwards_officiate() -> None:
    async with lab() as (bench, box, robot):
        box.say("START")
        await until(lambda: robot.sees(TeamPhase.PLAY, running=True), "play")
        refused = await bench.live.act(RefereeAction(action=ActionName.GOAL, side=Side.CYAN))
        assert refused.reason == "a league's referee box is connected and officiates; only stop is accepted"
        assert (await bench.live.act(RefereeAction(action=ActionName.STOP))).accepted
        await box.close()
        await until(lambda: not bench.live.state.refbox, "the box to be gone")
        assert (await bench.live.act(RefereeAction(action=ActionName.GOAL, side=Side.CYAN))).accepted
        await until(lambda: robot.sight.game.our_score == 1, "the goal")


def test_the_state_is_published_on_change_and_once_a_second_with_a_report_for_health() -> None:
    medium, clock = SharedState(), SteppedClock()
    reader = medium.open_bus(SETUP.match, SteppedClock())
    states, healths = reader.subscribe(STATE), reader.subscribe(HEALTH)
    match = ServiceWithoutHost(medium.open_bus(SETUP.match, clock), SETUP)
    for step in range(311):
        if step == 50:
            asked = reader.query(ACTION, RefereeAction(action=ActionName.STOP))
        match.update()
        clock.sleep_until(clock.now() + 0.01)
    assert asked.result(0.0).accepted
    times = [received.message().time for received in iter(states.receive, None)]
    assert times == pytest.approx([0.0, 0.5, 1.5, 2.5], abs=0.02)
    assert [received.message().pace for received in iter(healths.receive, None)] == 4 * ["no host"]
