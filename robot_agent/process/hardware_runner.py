"""Runs a brain on a robot's own hardware, at the robot's own rate: readings in, a sight, a demand out."""

import math
from typing import NamedTuple

from robot_agent.hardware.clearance import keep_clear
from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.own_percepts import OwnPercepts
from robot_agent.process.brain_runner import BrainRunner
from robot_agent.process.timing import IDLE_S
from robot_agent.sdk.contract import Brain, Briefing
from runtime.bus.contract import Bus
from runtime.process.process_log import Level, log_line
from runtime.process.timing import LINK_GRACE_S
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Outcome, ReceivedRadio, Sight
from schemas.messages.soccer.game import GameState, GameView
from schemas.soccer.game import OfficiatingMode, Phase, TeamPhase
from schemas.topics import COMMAND, HARDWARE, SIGHT, STATE
from schemas.wire.message import valid

_OLD_NEWS = 1.0
"""s after which the news of a host are too old to drive by."""


class News(NamedTuple):
    """What a robot knows of its match that its own sensors do not tell."""

    tick: int
    """The tick that commands answer."""
    time: float
    """Time of the match in s."""
    game: GameView
    radio: dict[str, ReceivedRadio] = {}
    order: CoachOrder | None = None


class HardwareRunner(BrainRunner):
    """A robot on hardware in the match of a host, which gives it game, order and radio in its sights."""

    def __init__(self, guard: HardwareGuard, setup: Setup, bus: Bus, brain: Brain, robot: str) -> None:
        super().__init__(bus, brain, robot)
        self.guard = guard
        self._robot, self._side, self._period = robot, setup.sides[robot], setup.time.tick
        self._setup = setup.for_robot(robot)
        self._percepts = OwnPercepts()
        self._due = self._began = guard.time
        self._health_due = 0.0
        self._tick = -1
        self._sent_tick: int | None = None
        """The tick of the newest command that was sent."""
        self._demanded: int | None = None
        """The tick of the robot's newest demand."""
        self._news: News | None = None
        self._news_at = 0.0
        self._health = bus.publisher(HARDWARE, robot=robot)
        self._states = bus.subscribe(STATE, history=True)
        self._attack: int | None = None
        """Sign of the x direction that the robot's team attacks; None before it is known."""
        self._game: GameState | None = None
        self._game_at = 0.0

    def next_sight(self, timeout: float | None) -> Sight | None:  # noqa: ARG002 - it waits for its own rate
        """The sight that is due next, from the robot's own sensors; None before a pose and news of the match.

        Raises:
            HardwareError: the hardware fails.
        """
        self._wait()
        readings = self.guard.sense()
        now = self.guard.time
        self._percepts.update(readings)
        self._publish_health(now)
        self._hear(now)
        news, newest = self._news, self._percepts.newest
        if news is None or self._attack is None or not self._is_up_to_date(now):
            return None  # the brain is not asked, and the guard falls back
        percept = self._percepts.percept(now, self._attack)
        late = now - self._news_at
        time = news.time + late
        self._tick = max(self._tick + 1, round(time / self._period))
        return Sight(
            tick=self._tick,
            time=round(time, 6),
            robot=self._robot,
            side=self._side,
            self=percept.motion(),
            ball=self._percepts.ball_sight(percept),
            holding=newest.holding,
            kicker_ready=newest.kicker_ready,
            stuck=newest.stuck,
            obstacles=percept.obstacles,
            obstacles_age=percept.obstacles_age,
            radio={name: one.replace(age=round(one.age + late, 4)) for name, one in news.radio.items()},
            game=news.game,
            order=news.order,
            outcome=Outcome(answers_tick=self._demanded, refused=self.guard.refused),
            sensors=self._percepts.readings(now),
        )

    def restart(self, brain: Brain) -> None:
        """As in `Runner`; the news of a match that is over are forgotten, and which way the team attacked."""
        super().restart(brain)
        self._tick, self._news, self._sent_tick, self._attack = -1, None, None, None

    def _think(self, sight: Sight) -> bytes:
        """Decide, and let the hardware do it; the host's sight is answered."""
        command = Command.decode(super()._think(sight))
        clearance, drive = self.guard.settings.clearance, command.drive
        if clearance is not None:
            drive = keep_clear(drive, sight, self._setup, clearance)
        self.guard.actuate(command.replace(drive=drive), command.drive)
        self._demanded = sight.tick
        return command.replace(answers_tick=self._news.tick if self._news is not None else sight.tick).encode()

    def _wait(self) -> None:
        """Wait for the next moment of the robot's own rate; moments that were missed are left out."""
        clock, now = self._clock, self.guard.time
        self._due = max(self._due + self._period, now)
        clock.sleep_until(clock.now() + self._due - now)

    def _is_up_to_date(self, now: float) -> bool:
        """Whether the robot knows where it is, and how the match stands: one that is off the field gets no sights."""
        posed = self._percepts.posed
        return posed is not None and now - posed <= self.guard.settings.watchdog and now - self._news_at <= _OLD_NEWS

    def _send(self) -> None:
        """Send the answer to a sight of the host once, however often the robot has thought meanwhile."""
        if self._news is not None and self._news.tick != self._sent_tick:
            self._sent_tick = self._news.tick
            super()._send()

    def _publish_health(self, now: float) -> None:
        if now >= self._health_due:
            self._health_due = now + IDLE_S
            self._health.put(self.guard.health())
            if self._percepts.posed is None and now - self._began > _OLD_NEWS:
                self._began = math.inf  # said once
                log_line(f"{self._robot}: sense has given no motion yet, and a brain is asked with one", Level.WARNING)

    def _hear(self, now: float) -> None:
        """Take over what has arrived."""
        self._hear_game(now)
        while (sight := super().next_sight(0.0)) is not None:
            self._news = News(sight.tick, sight.time, sight.game, sight.radio, sight.order)
            self._news_at = now

    def _hear_game(self, now: float) -> None:
        """Take over the newest state of the game."""
        while (received := self._states.receive()) is not None:
            state: GameState | None = valid(received.message)
            if state is not None:
                self._attack = self._side.attack(state.cyan_attacks)
                self._game, self._game_at = state, now


class RunnerWithoutHost(HardwareRunner):
    """A robot on hardware without a host, whose teammates hear each other's commands.

    The game is free. Under manual officiating it is what a gateway publishes; without news of it the game is stopped.
    """

    def __init__(self, guard: HardwareGuard, setup: Setup, bus: Bus, brain: Brain, robot: str) -> None:
        super().__init__(guard, setup, bus, brain, robot)
        self._attack = self._side.attack(1)
        self._own_sights = bus.publisher(SIGHT, robot=robot)
        self._mates = [bus.subscribe(COMMAND, newest=True, robot=mate) for mate in Briefing.of(robot, setup).teammates]
        self._heard: dict[str, tuple[float, ReceivedRadio]] = {}
        """Teammate → its newest radio message, and when it arrived."""
        self._is_officiated = setup.officiating is OfficiatingMode.MANUAL
        self._is_heard: bool | None = None
        """Whether there are news of the game; None before it is known."""

    def next_sight(self, timeout: float | None) -> Sight | None:
        """As in `HardwareRunner`; the sight is published for recorders."""
        sight = super().next_sight(timeout)
        if sight is not None:
            self._clock.sim_ns = round(sight.time * 1e9)
            self._own_sights.put(sight)
        return sight

    def _think(self, sight: Sight) -> bytes:
        self._news = self._news and self._news._replace(tick=sight.tick)
        return super()._think(sight)

    def _hear(self, now: float) -> None:
        for mate in self._mates:
            received = mate.receive()
            command = valid(received.message) if received is not None else None
            if received is not None and command is not None and command.radio is not None:
                self._heard[received.chunks["robot"]] = now, ReceivedRadio.of(command.radio)
        radio = {name: one.replace(age=round(now - then, 4)) for name, (then, one) in self._heard.items()}
        self._hear_game(now)
        game = self._view(now) if self._is_officiated else None
        if game is None:
            game = GameView(phase=TeamPhase.PLAY, running=True, clock=round(now, 4), our_score=0, their_score=0)
        record = game.robots.get(self._robot)
        is_off = record is not None and record.off_field is not None
        self._news, self._news_at = None if is_off else News(self._tick, now, game, radio), now

    def _view(self, now: float) -> GameView:
        """The game as it is officiated; stopped without news."""
        state = self._game or GameState(tick=0, time=0.0, phase=Phase.STOPPED)
        is_heard = self._game is not None and now - self._game_at <= LINK_GRACE_S
        if is_heard is not self._is_heard:
            self._is_heard = is_heard
            what = "that of a gateway" if is_heard else "stopped: no gateway publishes it; start touchline coach bridge"
            log_line(f"{self._robot}: the game is {what}", Level.INFO if is_heard else Level.WARNING)
        if not is_heard:
            state = state.replace(phase=Phase.STOPPED, side=None, running=False)
        return GameView.of(state, self._side, self._setup.teams[self._side].robots)
