"""The paper's multi-robot experiments (its section V), each by its name, on a real host with real brains and a coach.

The first: with three robots and three static rivals the coach sees everybody where they are, and the robots receive
what the coach commands. The second: in the same world the robots move as the real robots' code says. The third: both
sides move, each in a frame of its own.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from coach_gateway.match.orders import OrderStatus
from coach_gateway.match.team_obstacles import team_obstacles
from robot_agent.loading.brain_loader import load_brain
from robot_agent.process.runner import Runner
from robot_agent.sdk.contract import Briefing
from robot_agent.teams.nubot import NuBot
from robot_agent.teams.nubot.machine import State
from robot_agent.teams.nubot.trajectory import ROTATION, TRANSLATION
from runtime.bus.contract import Bus, PendingReply
from schemas.config.match_config import load_match
from schemas.config.scene import Scene, load_scene
from schemas.messages.coach import CoachMode, CoachTest
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, Phase, TeamPhase
from schemas.topics import SCENE
from sim_host.server.host import Host
from sim_host.server.pace import Lockstep
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock

CYAN = ("cyan1", "cyan2", "cyan3")
RIVALS = ("magenta1", "magenta2", "magenta3")


class Experiment:
    """A host, an agent for each robot that moves, and a coach, who are three programs on one bus."""

    def __init__(self, scene: str, **flags: Any) -> None:
        brains = {f"teams.{side}.brain": "robot_agent.teams.nubot:NuBot" for side in Side}
        config = load_match(None, {"scene": scene, "referee.mode": "manual", **brains, **flags})
        self.scene: Scene = load_scene(scene)
        medium = SharedState()
        coach = self._attended(medium.open_bus(config.name, SteppedClock()))
        self.client, self.seen = HostClient(coach), MatchFollower(coach, details=True)
        self.client.orders.update()
        self.host = Host(config, medium.open_bus(config.name, SteppedClock()))
        setup = self.host.simulation.setup()
        self.setup = setup
        self.agents: dict[str, Runner] = {}
        self.sights: dict[str, Sight] = {}
        """Robot → what it was shown last."""
        for robot in (robot for side in Side for robot in config.robots(side)):
            bus = medium.open_bus(config.name, SteppedClock())
            brain = load_brain("robot_agent.teams.nubot:NuBot", Briefing.of(robot, setup))
            self.agents[robot] = Runner(bus, brain, robot)
            bus.declare_alive("agent", robot)
        assert isinstance(self.host.pace, Lockstep)
        self.host.pace.step_agents = self._let_agents_answer
        self.host.wait_for_all()
        self.host.begin()
        self.trace: list[dict[str, Any]] = []
        """The truth of each tick."""

    def _let_agents_answer(self) -> None:
        for robot, agent in self.agents.items():
            if (sight := agent.next_sight(0.0)) is not None:
                self.sights[robot] = sight
                agent.answer(sight)

    def tick(self) -> None:
        self.trace.append(self.host.tick().world)

    def play(self, until: Callable[[], bool], most: float) -> bool:
        """Play until something is so, for at most `most` s of simulated time; whether it became so."""
        for _ in range(round(most / self.setup.time.tick)):
            self.tick()
            if until():
                return True
        return False

    def _attended(self, coach: Bus) -> Bus:
        """A bus whose queries are answered in the next tick: their duration does not change the match."""
        query = coach.query

        def query_and_tick(*words: Any, **more: Any) -> PendingReply:
            reply = query(*words, **more)
            self.tick()
            return reply

        setattr(coach, "query", query_and_tick)  # noqa: B010  in place of a method
        return coach

    def order(self, **content: Any) -> int:
        """Order cyan; the number of the order."""
        return self.client.order(Side.CYAN, **content).sequence

    def machine(self, robot: str) -> State:
        """The state of a robot's behaviour machine."""
        brain = self.agents[robot].brain
        assert isinstance(brain, NuBot)
        return brain._machine.state

    def ball_lies_on_its_spot(self) -> bool:
        """Whether the ball lies where the restart is taken from."""
        spot, ball = self.host.simulation.state.spot, self.trace[-1]["ball"]
        return spot is not None and math.dist(spot, (ball["x"], ball["y"])) < 0.01

    def where(self, name: str) -> tuple[float, float]:
        """Where a robot is, in truth."""
        robot = self.trace[-1]["robots"][name]
        return robot["x"], robot["y"]


@pytest.fixture
def made() -> Iterator[Callable[..., Experiment]]:
    experiments: list[Experiment] = []

    def make(scene: str, **flags: Any) -> Experiment:
        experiments.append(Experiment(scene, **flags))
        return experiments[-1]

    yield make
    for experiment in experiments:
        experiment.host.simulation.close()


@pytest.fixture
def static(made: Callable[..., Experiment]) -> Experiment:
    """Three robots and three static rivals."""
    return made("paper_static")


def test_one_the_coach_sees_every_model_where_it_was_spawned(static: Experiment) -> None:
    static.order(mode=CoachMode.HOLD)
    static.seen.update()
    world = static.seen.world
    assert world is not None and list(world.robots) == [*CYAN, *RIVALS]
    for robot in static.scene.robots:
        shown = world.robots[robot.name]
        assert (shown.x, shown.y) == pytest.approx((robot.x, robot.y), abs=0.02)
        assert math.cos(shown.heading - robot.heading) > 0.999
    assert (world.ball.x, world.ball.y) == pytest.approx((0.0, 0.0), abs=0.02)


def test_one_the_coach_sees_the_rivals_where_its_robots_believe_them(static: Experiment) -> None:
    """The coach of a UDP program has no truth: it knows what its robots have sent."""
    static.order(mode=CoachMode.HOLD)
    static.play(lambda: False, 1.0)
    static.seen.update()
    assert static.seen.world is not None
    beliefs = {name: belief for name, belief in static.seen.beliefs.items() if name in CYAN}
    found = team_obstacles(beliefs, static.seen.world.time)
    assert len(found) == len(RIVALS)
    for rival in RIVALS:
        nearest = min(found, key=lambda one: math.dist((one.x, one.y), static.where(rival)))
        assert math.dist((nearest.x, nearest.y), static.where(rival)) < 0.3


def test_one_the_coach_sees_the_models_move_as_they_do(static: Experiment) -> None:
    static.order(mode=CoachMode.TEST, test=CoachTest.MOVE, robot_a="cyan2", point_a={"x": -4.0, "y": 4.0})
    for _ in range(10):
        static.play(lambda: False, 0.2)
        static.seen.update()
        world = static.seen.world
        assert world is not None and world.tick == static.trace[-1]["tick"]
        for name in (*CYAN, *RIVALS):
            assert (world.robots[name].x, world.robots[name].y) == static.where(name)
    assert math.dist(static.where("cyan2"), (-2.0, 1.5)) > 1.0
    assert math.dist(static.where("magenta2"), (2.0, 1.5)) < 0.02


def test_one_every_robot_receives_the_coachs_order(static: Experiment) -> None:
    """In the paper the coach's socket reached one robot only, until a relay node was added."""
    number = static.order(mode=CoachMode.HOLD, max_speed=1.5)
    static.play(lambda: False, 0.1)
    for name in CYAN:
        order = static.sights[name].order
        assert order is not None and (order.sequence, order.mode, order.max_speed) == (number, CoachMode.HOLD, 1.5)
    static.client.orders.update()
    receipt = static.client.orders.book.receipt(Side.CYAN, number)
    assert (receipt.status, receipt.acknowledged, receipt.missing) == (OrderStatus.ACTIVE, CYAN, ())


COMMANDS = {
    ActionName.STOP: (None, Phase.STOPPED, TeamPhase.STOPPED),
    ActionName.KICK_OFF: (Side.CYAN, Phase.KICK_OFF, TeamPhase.OUR_KICK_OFF),
    ActionName.CORNER: (Side.MAGENTA, Phase.CORNER, TeamPhase.THEIR_CORNER),
    ActionName.THROW_IN: (Side.CYAN, Phase.THROW_IN, TeamPhase.OUR_THROW_IN),
    ActionName.FREE_KICK: (Side.MAGENTA, Phase.FREE_KICK, TeamPhase.THEIR_FREE_KICK),
    ActionName.GOAL_KICK: (Side.CYAN, Phase.GOAL_KICK, TeamPhase.OUR_GOAL_KICK),
    ActionName.PENALTY: (Side.MAGENTA, Phase.PENALTY, TeamPhase.THEIR_PENALTY),
    ActionName.DROP_BALL: (None, Phase.DROP_BALL, TeamPhase.DROP_BALL),
}
"""The coach's basic commands: side, resulting phase, and that phase in the sights of cyan's robots."""


@pytest.mark.parametrize("action", COMMANDS)
def test_one_every_robot_receives_the_coachs_command(static: Experiment, action: ActionName) -> None:
    """Game-stop, kick-off, corner-ball "and etc."; then game-start."""
    side, phase, told = COMMANDS[action]
    reply = static.client.act(RefereeAction(action=action, side=side))
    assert reply.accepted, reply.reason
    assert static.play(lambda: {static.sights[name].game.phase for name in CYAN} == {told}, 20.0)
    static.seen.update()
    assert static.seen.state is not None and static.seen.state.phase is phase
    if phase is Phase.STOPPED:
        return
    assert static.play(static.ball_lies_on_its_spot, 20.0)  # as soon as no robot stands there
    reply = static.client.act(RefereeAction(action=ActionName.START))
    assert reply.accepted, reply.reason
    assert static.play(lambda: all(static.sights[name].game.running for name in CYAN), 1.0)


@pytest.mark.slow
@pytest.mark.parametrize("robot", [CYAN[0], *(pytest.param(one, marks=pytest.mark.long) for one in CYAN[1:])])
def test_two_each_robot_moves_as_in_the_state_machine_of_the_real_code(static: Experiment, robot: str) -> None:
    """Figure 5 of the paper with the constants of its code."""
    static.order(mode=CoachMode.TEST, test=CoachTest.MACHINE, robot_a=robot)
    began = len(static.trace)
    states: list[State] = []

    def is_home() -> bool:
        states.append(static.machine(robot))
        return states[-1] is State.HOME

    assert static.play(is_home, 60.0)
    order = [state for place, state in enumerate(states) if place == 0 or states[place - 1] is not state]
    path = [State.CHASE_BALL, State.MOVE_BALL, State.ROTATE_BALL, State.KICK_BALL, State.RESET, State.HOME]
    assert order[-len(path) :] == path
    entered = {state: static.trace[began + len(states) - 1 - states[::-1].index(state)] for state in states}
    truth = {state: world["robots"][robot] for state, world in entered.items()}
    dribbled = static.trace[began + states.index(State.ROTATE_BALL)]["robots"][robot]
    assert math.dist((dribbled["x"], dribbled["y"]), (4.0, -2.0)) < 0.3
    kicking = truth[State.KICK_BALL]
    to_goal = math.atan2(-kicking["y"], 9.0 - kicking["x"])
    assert math.cos(kicking["heading"] - to_goal) > math.cos(math.radians(5.0))
    assert math.dist((truth[State.HOME]["x"], truth[State.HOME]["y"]), (-4.0, -2.0)) < 0.3


def test_two_the_shot_goes_under_the_bar_between_the_posts(static: Experiment) -> None:
    static.order(mode=CoachMode.TEST, test=CoachTest.MACHINE, robot_a="cyan2")
    pitch = static.setup.pitch
    assert static.play(lambda: bool(static.trace[-1]["ball"]["x"] > pitch.goal_line), 60.0)
    ball = static.trace[-1]["ball"]
    assert abs(ball["y"]) < 0.5 * pitch.goal_width and ball["z"] < pitch.goal_height
    assert max(world["ball"]["z"] for world in static.trace) > 0.4


def test_two_motions_keep_to_the_speeds_of_the_code_and_static_rivals_stay(static: Experiment) -> None:
    static.order(mode=CoachMode.TEST, test=CoachTest.MACHINE, robot_a="cyan2", avoid=True)
    static.play(lambda: False, 1.0)
    stood = {name: static.where(name) for name in ("cyan1", "cyan3")}
    assert static.play(lambda: static.machine("cyan2") is State.HOME, 60.0)
    robots = [world["robots"]["cyan2"] for world in static.trace]
    assert 2.0 < max(math.hypot(robot["vx"], robot["vy"]) for robot in robots) <= TRANSLATION.top + 0.05
    assert max(abs(robot["omega"]) for robot in robots) <= ROTATION.top + 0.05
    for rival in (robot for robot in static.scene.robots if robot.name in RIVALS):
        assert math.dist(static.where(rival.name), (rival.x, rival.y)) < 0.05
    assert all(math.dist(static.where(name), place) < 0.05 for name, place in stood.items())


def test_two_after_the_world_is_reset_the_machine_runs_again(static: Experiment) -> None:
    """Gazebo's Reset World."""
    static.order(mode=CoachMode.TEST, test=CoachTest.MACHINE, robot_a="cyan2")
    assert static.play(lambda: static.machine("cyan2") is State.HOME, 60.0)
    reply = static.client.ask(SCENE, SceneRequest(operation=SceneOperation.RESET))
    assert reply.accepted and reply.episode == 2
    assert static.play(lambda: static.machine("cyan2") is State.CHASE_BALL, 1.0)
    assert static.play(lambda: static.machine("cyan2") is State.HOME, 60.0)


def test_three_both_sides_see_the_same_world_each_from_its_own_end_and_both_move(
    made: Callable[..., Experiment],
) -> None:
    """The same code on both sides, the frames reversed."""
    both = made("paper_two_sides", **{"noise.preset": "perfect"})
    both.tick()
    for ours, theirs in zip(CYAN, RIVALS, strict=True):
        mine, other = both.sights[ours].self, both.sights[theirs].self
        assert (mine.x, mine.y, math.cos(mine.heading)) == pytest.approx((other.x, other.y, math.cos(other.heading)))
    began = {robot.name: (robot.x, robot.y) for robot in both.scene.robots}
    moved: dict[str, float] = dict.fromkeys(began, 0.0)

    def have_moved() -> bool:
        for name, place in began.items():
            moved[name] = max(moved[name], math.dist(both.where(name), place))
        return all(max(moved[name] for name in side) > 1.0 for side in (CYAN, RIVALS))

    assert both.play(have_moved, 20.0)
