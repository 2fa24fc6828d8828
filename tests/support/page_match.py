"""A match in this process, its host and its robots in threads, which pages look at."""

import threading
import time
from collections.abc import Callable
from typing import Any

from coach_gateway.match.host_client import HostClient
from robot_agent.loading.brain_loader import load_brain
from robot_agent.process.runner import Runner
from robot_agent.sdk.contract import Briefing
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.messages.command import Command
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import GameEvent, GameState, RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation
from schemas.side import Side
from schemas.soccer.game import ActionName
from schemas.topics import EVENT, Topic
from sim_host.server.host import Host
from support.answers import answer_next
from support.in_process_bus import SharedState
from support.page_gateway import SOON
from support.process_story import wait_for

TEAMS = {
    "cyan": {"name": "Blues", "brain": "robot_agent.teams.simple:Simple", "size": 2},
    "magenta": {"name": "Reds", "brain": "robot_agent.teams.simple:Simple", "size": 2},
}


class Still:
    """A brain that lets its robot stand."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)


class Announcing:
    """A brain that lets its robot stand, and sends a role."""

    def __init__(self, briefing: Briefing) -> None:
        del briefing

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, radio=Radio(role="right supporter", intention="hold the place"))


class Match:
    """Host and robots, each side of the bus in a thread of its own; the host can go and come again."""

    def __init__(self, *, still: bool = False, **words: Any) -> None:
        """`still` has all robots stand where they are; the other words are those of the match file."""
        content = {"name": "friendly", "seed": 7, "pace": "realtime", "duration": 600.0, "teams": TEAMS, **words}
        self.config = MatchConfig.model_validate(content)
        self.medium = SharedState()
        self._over = threading.Event()
        self._ear = self.medium.open_bus("friendly", WallClock()).subscribe(EVENT)
        self._events: list[GameEvent] = []
        self.start()
        setup = self.host.simulation.setup()
        self._runners = []
        for side in Side:
            for robot in self.config.robots(side):
                bus = self.medium.open_bus("friendly", WallClock())
                briefing = Briefing.of(robot, setup)
                brain = Still() if still else load_brain(self.config.team(side).brain or "", briefing)
                self._runners.append(Runner(bus, brain, robot))
                bus.declare_alive("agent", robot)
        self._robots = threading.Thread(target=self._answer)
        self._robots.start()

    def start(self) -> None:
        """A host begins the match."""
        self._bus = self.medium.open_bus("friendly", WallClock())
        self.host = Host(self.config, self._bus)
        self._hosting = threading.Thread(target=self.host.run)
        self._hosting.start()

    def signal_kick_off(self) -> None:
        """The referee signals the kick-off of the half; in manual officiating people have to give START."""
        with self.medium.open_bus("friendly", WallClock()) as bus:
            starter = HostClient(bus, SOON)
            reply = starter.act(RefereeAction(action=ActionName.START))
            assert reply.accepted, reply.reason
            assert starter.referee_seat(SeatOperation.LEAVE).accepted

    def stop(self) -> None:
        """The host goes."""
        self.host.stop()
        self._hosting.join(SOON)
        self.host.simulation.close()
        self._bus.close()

    def close(self) -> None:
        self.stop()
        self._over.set()
        self._robots.join(SOON)

    def until(self, holds: Callable[[], Any]) -> None:
        """Wait until something is true; it is looked at again and again."""
        wait_for(holds, limit=SOON)

    @property
    def state(self) -> GameState:
        now = self.host.simulation.now
        state: GameState = self.host.simulation.state.game_state(now.tick, now.time, 1)
        return state

    @property
    def world(self) -> dict[str, Any]:
        world: dict[str, Any] = self.host.simulation.now.world
        return world

    @property
    def events(self) -> list[GameEvent]:
        """All that has happened so far."""
        self._events += [received.message() for received in iter(self._ear.receive, None)]
        return self._events

    def said(self, text: str) -> bool:
        """Whether there has been an event with this text."""
        return any(event.text == text for event in self.events)

    def hear(self, topic: Topic) -> Callable[[], list[Any]]:
        """A function for the messages on a topic since its last call."""
        ear = self.medium.open_bus("friendly", WallClock()).subscribe(topic)
        return lambda: [received.message() for received in iter(ear.receive, None)]

    def where(self, robot: str) -> tuple[float, float]:
        truth = self.world["robots"][robot]
        return truth["x"], truth["y"]

    def _answer(self) -> None:
        while not self._over.is_set():
            if not [runner for runner in self._runners if answer_next(runner)]:
                time.sleep(0.002)
