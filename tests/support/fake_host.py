"""A host on the in-process bus that publishes messages on demand and keeps the requests it received."""

import asyncio
import threading
from collections.abc import Callable, Mapping
from typing import Any

from runtime.bus.contract import Bus, Publisher, Query
from runtime.process.clock import Clock, WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.messages.debug import Debug, RobotDebug
from schemas.messages.health import Health
from schemas.messages.radio import Belief, Radio
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import ActionReply, GameState, RefereeAction
from schemas.messages.world import BallTruth, World
from schemas.side import Side
from schemas.soccer.game import Phase
from schemas.topic import Topic
from schemas.topics import ACTION, ACTIVE_ORDER, BELIEF, DEBUG, EVENT, HEALTH, MANUAL, ORDER, SETUP, STATE, WORLD
from schemas.wire.message import Message
from support.in_process_bus import SharedState
from support.messages import make_event, make_robot, make_world

MATCH = "friendly"
Answer = Callable[[Any], Message | None]


class FakeHost:
    """Replies with its setup, accepts every action, and publishes only what a test demands."""

    def __init__(
        self,
        medium: SharedState,
        config: MatchConfig | None = None,
        answers: Mapping[Topic, Answer] | None = None,
        *,
        rules: str = "friendly",
        clock: Clock | None = None,
        in_threads: bool = False,
    ) -> None:
        """`answers` has the replies to further topics, or replaces those of this host.

        With `in_threads`, each topic is answered in a thread of its own; otherwise `serve` answers in an event loop.
        """
        self.medium = medium
        self.config = config or MatchConfig()
        self.bus: Bus = medium.open_bus(MATCH, clock or WallClock())
        self.setup = Setup.of(self.config, load_profile("msl"), load_rule_book(rules))
        self.state = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME)
        self.asked: list[Any] = []
        """Requests, in order, without those for the setup."""
        self.answer: Callable[[RefereeAction], ActionReply | None] = lambda _: ActionReply(accepted=True)
        """The reply to an action; None for none at all."""
        self.hands, self.orders = self.bus.subscribe(MANUAL), self.bus.subscribe(ORDER)
        self._given: list[tuple[Side, CoachOrder]] = []
        self._publishers: dict[str, Publisher] = {}
        self._answers = {SETUP.key: lambda _: self.setup, ACTION.key: lambda action: self.answer(action)}
        self._answers |= {topic.key: answer for topic, answer in (answers or {}).items()}
        self._servers = [self.bus.serve(topic) for topic in {SETUP, ACTION, *(answers or {})}]
        self._threads = [
            threading.Thread(target=self._serve, args=(server,), daemon=True)
            for server in (self._servers if in_threads else ())
        ]
        for thread in self._threads:
            thread.start()
        self.bus.declare_alive("host", "host")

    async def serve(self, stop: asyncio.Event) -> None:
        """Answer requests in an event loop."""
        while not stop.is_set():
            for server in self._servers:
                while (query := server.receive()) is not None:
                    self._reply(query)
            await asyncio.sleep(0.002)

    def close(self) -> None:
        """Leave the match."""
        self.bus.close()
        for thread in self._threads:
            thread.join()

    def _serve(self, server: Any) -> None:
        while (query := server.receive(None)) is not None:
            self._reply(query)

    def _reply(self, query: Query) -> None:
        if query.key == SETUP.key:
            query.reply(self._answers[query.key](None))
            return
        request = query.message()
        self.asked.append(request)
        answer = self._answers[query.key](request)
        if answer is not None:
            query.reply(answer)

    @property
    def given_orders(self) -> list[tuple[Side, CoachOrder]]:
        """All orders that were sent, with the side that they are for."""
        for received in iter(self.orders.receive, None):
            self._given.append((Side(received.chunks["side"]), received.message()))
        return self._given

    def put(self, topic: Topic, message: Message, **chunks: str) -> None:
        """Publish a message."""
        key = topic.fill(**chunks)
        if key not in self._publishers:
            self._publishers[key] = self.bus.publisher(topic, **chunks)
        self._publishers[key].put(message)

    def say(self, **changes: Any) -> None:
        """Publish the next game state."""
        tick = self.state.tick + 1
        self.state = self.state.replace(**{"tick": tick, "time": tick * 0.02, **changes})
        self.put(STATE, self.state)

    def tell(self, text: str) -> None:
        """Publish an event of the newest state's tick."""
        self.happen(self.state.tick, text)

    def happen(self, tick: int, text: str) -> None:
        """Publish an event of a tick."""
        self.put(EVENT, make_event(tick, text))

    def show(self, **changes: Any) -> World:
        """Publish a world in which every robot has its own place and faces its opponents' goal."""
        robots = {
            name: make_robot(
                -side.attack(1) * (1.0 + number),
                0.5 * number,
                0.0 if side is Side.CYAN else 3.0,
                vx=1.0,
                omega=0.5,
                holding=name == "cyan2",
            )
            for side in Side
            for number, name in enumerate(self.config.robots(side))
        }
        ball = BallTruth(x=2.0, y=-1.0, z=0.11, vx=3.0, vy=0.0, vz=0.0)
        content = {"tick": self.state.tick, "time": self.state.time, "robots": robots, "ball": ball}
        world = World(**{**content, **changes})
        self.put(WORLD, world)
        return world

    def believe(self, robot: str, radio: Radio) -> None:
        """Publish a robot's belief."""
        side = next(side for side in Side if robot in self.config.robots(side))
        belief = Belief(tick=self.state.tick, time=self.state.time, robot=robot, radio=radio)
        self.put(BELIEF, belief, side=side.value, robot=robot)

    def play(self, tick: int) -> None:
        """Publish game, health, beliefs, drawings and the world of one tick; a reader of this world has the rest."""
        at: dict[str, Any] = {"tick": tick, "time": tick * 0.02}
        self.put(STATE, GameState(**at, phase=Phase.PLAY))
        self.put(HEALTH, Health(**at, pace="realtime", real_time_factor=1.0))
        for side in Side:
            robot = f"{side}1"
            self.put(BELIEF, Belief(**at, robot=robot, radio=Radio(role="striker")), side=side.value, robot=robot)
            debug = RobotDebug(**at, robot=robot, debug=Debug(values={"tick": tick}))
            self.put(DEBUG, debug, side=side.value, robot=robot)
        self.put(WORLD, make_world(tick, (tick, 0.0)))

    def stand(self, side: Side, order: CoachOrder, refused: dict[str, str] | None = None, **acknowledged: bool) -> None:
        """Publish an active order."""
        active = ActiveOrder(tick=1, time=0.02, order=order, acknowledged=acknowledged, refused=refused or {})
        self.put(ACTIVE_ORDER, active, side=side.value)
