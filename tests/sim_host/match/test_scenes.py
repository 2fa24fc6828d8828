"""Scenes in a running match: loaded, changed, reset, and simulated again."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.roster import Placement
from schemas.config.scene import Scene, SceneBall, SceneGame, SceneRobot, load_scene, shipped_scenes
from schemas.messages.applied import Applied
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.radio import Radio
from schemas.messages.scene import SceneReply, SceneRequest
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, EventKind, Phase, TeamPhase
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation, TickResult

WALL = ObstacleConfig(name="wall", shape=Shape.BOX, place=[3.0, 3.0], size=[0.2, 2.0, 0.5])


@pytest.fixture
def simulation_of() -> Iterator[Callable[..., Simulation]]:
    made: list[Simulation] = []

    def make(**words: Any) -> Simulation:
        given = {key.replace("__", "."): value for key, value in words.items()}
        made.append(Simulation(load_match(None, {"duration": 60.0, "noise.preset": "perfect"} | given)))
        return made[-1]

    yield make
    for simulation in made:
        simulation.close()


@pytest.fixture
def simulation(simulation_of: Callable[..., Simulation]) -> Simulation:
    return simulation_of()


def ask(simulation: Simulation, operation: str, **content: Any) -> SceneReply:
    return simulation.handle_scene(validated(SceneRequest, {"operation": operation, **content}))


def done(simulation: Simulation, operation: str, **content: Any) -> TickResult:
    """The tick after something that must not be refused."""
    reply = ask(simulation, operation, **content)
    assert reply.accepted, reply.reason
    return simulation.step({})


def robot(name: str, x: float, y: float, **more: Any) -> SceneRobot:
    return SceneRobot(name=name, side=Side.CYAN if name.startswith("cyan") else Side.MAGENTA, x=x, y=y, **more)


def busy(simulation: Simulation, ticks: int) -> list[TickResult]:
    """All robots drive, dribble, kick and send radio messages."""
    played = []
    for count in range(ticks):
        said = {
            name: Command(
                answers_tick=simulation.now.tick,
                drive=Drive(vx=1.5, vy=0.3 * (place % 3 - 1), omega=0.4 * (place % 2)),
                dribble=True,
                kick=Kick(mode=KickMode.GROUND, speed=4.0) if count % 20 == 19 else None,
                radio=Radio(role=name),
            )
            for place, name in enumerate(simulation.roster.names)
        }
        played.append(simulation.step(said))
    return played


def applied(tick: TickResult) -> Applied:
    """What a recording keeps of a tick."""
    return Applied.decode(tick.applied_encoded)


@pytest.mark.parametrize("name", shipped_scenes())
def test_every_scene_that_ships_can_be_loaded_on_its_pitch_and_played(name: str, simulation_of) -> None:
    scene = load_scene(name)
    simulation = simulation_of(profile=scene.profile or "msl")
    tick = done(simulation, "load", load=name)
    assert list(tick.world["robots"]) == [one.name for side in Side for one in scene.of(side)]
    for one in scene.robots:
        now = tick.world["robots"][one.name]
        assert (now["x"], now["y"]) == approx((one.x, one.y), abs=1e-3)
    rolled = (scene.ball.x + 0.02 * scene.ball.vx, scene.ball.y + 0.02 * scene.ball.vy)
    assert (tick.world["ball"]["x"], tick.world["ball"]["y"]) == approx(rolled, abs=5e-3)
    assert simulation.state.phase is scene.game.phase
    assert set(tick.sights) == set(tick.world["robots"])
    busy(simulation, 50)


def test_a_match_can_start_in_a_scene(simulation_of) -> None:
    simulation = simulation_of(scene="paper_static", profile="paper")
    assert simulation.roster.still == ("magenta1", "magenta2", "magenta3")
    assert simulation.now.world["robots"]["magenta1"]["x"] == 6.0
    assert simulation.state.phase is Phase.PLAY
    assert simulation.config.robots(Side.MAGENTA) == []
    assert simulation.config.robots(Side.CYAN) == ["cyan1", "cyan2", "cyan3"]


def test_bodies_are_placed_while_the_match_runs_with_a_velocity(simulation) -> None:
    busy(simulation, 30)
    places = [
        Placement(body="cyan2", x=4.0, y=-2.0, heading=1.0, vx=1.0),
        Placement(body="ball", x=-3.0, y=4.0, vx=2.0),
    ]
    tick = done(simulation, "place", place=places)
    moved, ball = tick.world["robots"]["cyan2"], tick.world["ball"]
    assert (moved["x"], moved["y"], moved["heading"]) == approx((4.02, -2.0, 1.0), abs=0.02)
    assert (ball["x"], ball["y"]) == approx((-2.96, 4.0), abs=0.01)
    assert tick.applied["placements"] == places
    assert tick.applied["checkpoint"]
    (event,) = [event for event in tick.events if event.kind is EventKind.SCENE]
    assert event.text == "operator places cyan2 at (4.00, -2.00), the ball at (-3.00, 4.00)"
    assert tick.world["episode"] == 1


def test_a_ball_that_is_set_down_with_a_velocity_rolls_and_is_slowed_as_it_is_set(simulation) -> None:
    """v² = 2 a s: from 2 m/s a ball stops after 4 m at 0.5 m/s², and after 1 m at 2 m/s²; tolerance 2 %.

    The parameter is set while the match runs.
    """

    def way() -> float:
        done(simulation, "place", place=[Placement(body="ball", x=-4.0, y=6.0, vx=2.0)])
        while simulation.now.world["ball"]["vx"] > 1e-3:
            simulation.step({})
        return float(simulation.now.world["ball"]["x"]) + 4.0

    def parameters(operation: str, **values: Any) -> None:
        named = {f"ball.{key}": value for key, value in values.items()}
        request = ParametersRequest(operation=ParameterOperation(operation), values=named)
        assert simulation.handle_parameters(request).accepted

    quiet = SceneGame(phase=Phase.STOPPED)  # in play the referee drops a ball that lies still
    done(simulation, "load", scene=Scene(description="x", game=quiet, robots=[robot("cyan1", 0.0, 0.5)]))
    usual = way()
    parameters("set", rolling_deceleration=2.0)
    assert way() == approx(usual / 4.0, rel=0.05)
    parameters("reset")
    assert way() == approx(usual, rel=1e-6)


def test_a_robot_is_added_removed_and_put_back(simulation) -> None:
    busy(simulation, 10)
    tick = done(simulation, "remove", remove=["cyan4", "magenta2"])
    assert "cyan4" not in tick.world["robots"] and "cyan4" not in tick.sights
    assert len(Sight.decode(tick.sights["cyan2"]).obstacles) == 7
    assert [entry.name for entry in applied(tick).robots or []] == list(tick.world["robots"])
    assert simulation.setup().teams[Side.CYAN].robots == ["cyan1", "cyan2", "cyan3", "cyan5"]
    busy(simulation, 10)
    tick = done(simulation, "add", robots=[robot("cyan4", 3.0, -4.0), robot("magenta9", 4.0, -4.0, type="slow")])
    assert (tick.world["robots"]["cyan4"]["x"], tick.world["robots"]["cyan4"]["y"]) == approx((3.0, -4.0), abs=1e-3)
    assert Sight.decode(tick.sights["magenta9"]).side is Side.MAGENTA
    assert simulation.setup().teams[Side.MAGENTA].types == {"magenta9": "slow"}
    busy(simulation, 10)


def test_a_robot_that_stays_keeps_its_perception_and_its_radio_messages(simulation_of) -> None:
    simulation = simulation_of(noise__preset="profile", radio__delay=0.06)
    busy(simulation, 20)
    before = Sight.decode(simulation.now.sights["cyan2"])
    done(simulation, "remove", remove=["cyan1", "magenta2"])
    tick = done(simulation, "add", robots=[robot("cyan9", -3.0, 5.0)])
    after, new = Sight.decode(tick.sights["cyan2"]), Sight.decode(tick.sights["cyan9"])
    assert before.ball is not None and after.ball is not None
    assert abs(after.ball.x - before.ball.x) < 0.5
    assert set(after.radio) == {"cyan3", "cyan4", "cyan5"}
    assert all(heard.age < 0.12 for heard in after.radio.values())
    assert new.radio == {} and new.ball is None


def test_who_stays_goes_on_as_before_when_others_come_and_go(simulation_of) -> None:
    """Within a millimetre: a checkpoint rebuilds the world from poses and velocities."""
    ends = []
    for change in (False, True):
        simulation = simulation_of(teams__cyan__size=2, teams__magenta__size=2)
        for count in range(60):
            if change and count == 30:
                assert ask(simulation, "add", robots=[robot("cyan7", 8.0, 6.0)]).accepted
            simulation.step({"cyan1": Command(answers_tick=simulation.now.tick, drive=Drive(vx=2.0))})
        ends.append(simulation.now.world["robots"]["cyan1"]["x"])
    assert ends[0] == approx(ends[1], abs=1e-3)


def test_the_ball_may_lie_at_the_gap_of_a_robot_whose_frame_reaches_farther(simulation) -> None:
    keeper, ball = robot("cyan1", 1.0, 2.0, type="keeper"), SceneBall(x=1.35, y=2.0)
    assert ask(simulation, "load", scene=Scene(description="x", robots=[keeper], ball=ball)).accepted


def test_obstacles_are_put_up_and_taken_away(simulation) -> None:
    tick = done(simulation, "add", obstacles=[WALL])
    assert list(tick.world["obstacles"]) == ["wall"]
    assert applied(tick).obstacles == [WALL]
    done(simulation, "place", place=[Placement(body="ball", x=2.0, y=3.0, vx=3.0)])
    for _ in range(50):
        simulation.step({})
    assert simulation.now.world["ball"]["x"] < 3.0
    tick = done(simulation, "remove", remove=["wall"])
    assert "obstacles" not in tick.world
    assert applied(tick).obstacles == []


def test_a_robot_that_stands_still_in_the_scene_ignores_all_commands(simulation) -> None:
    done(simulation, "load", scene=Scene(description="x", robots=[robot("cyan1", 0.0, 3.0, agent=False)]))
    for _ in range(20):
        tick = simulation.step({"cyan1": Command(answers_tick=simulation.now.tick, drive=Drive(vx=2.0))})
    assert tick.world["robots"]["cyan1"]["x"] == approx(0.0, abs=1e-6)
    assert "stands still" in Sight.decode(tick.sights["cyan1"]).outcome.refused[0]


def test_a_scene_begins_another_episode_with_the_game_that_it_names(simulation) -> None:
    busy(simulation, 20)
    before = simulation.now
    tick = done(simulation, "load", load="penalty")
    assert (before.world["episode"], tick.world["episode"], applied(tick).episode) == (1, 2, 2)
    assert tick.tick == before.tick + 1 and tick.time > before.time
    sight = Sight.decode(tick.sights["magenta1"])
    assert (sight.game.phase, sight.game.episode) == (TeamPhase.THEIR_PENALTY, 2)
    assert simulation.state.spot == (7.4, 0.0)


def test_what_robots_answer_to_the_episode_before_moves_nothing_in_the_new_one(simulation) -> None:
    busy(simulation, 20)
    assert ask(simulation, "reset", to_match=True).accepted
    (tick,) = busy(simulation, 1)
    assert {one.drive for one in applied(tick).inputs.values()} == {Drive()}
    assert Sight.decode(tick.sights["cyan2"]).radio == {}


def test_reset_goes_back_to_the_scene_loaded_last_and_to_the_start_of_the_match(simulation) -> None:
    def places(tick: TickResult) -> dict[str, tuple[float, float]]:
        return {name: (one["x"], one["y"]) for name, one in tick.world["robots"].items()}

    start = places(simulation.now)
    first = places(done(simulation, "load", load="two_on_one"))
    busy(simulation, 40)
    again = done(simulation, "reset")
    assert places(again) == first
    assert (again.world["episode"], again.world["clock"]) == (3, approx(0.02))
    tick = done(simulation, "reset", to_match=True)
    assert {name: approx(place, abs=1e-6) for name, place in start.items()} == places(tick)
    assert simulation.state.score.cyan == 0
    assert simulation.now.world["episode"] == 4


def test_equal_resets_play_equal_episodes(simulation_of) -> None:
    """The world after a reset depends on the scene alone; noise and radio go on with the ticks."""
    simulation = simulation_of(noise__preset="perfect")
    ways = []
    for _ in range(2):
        done(simulation, "load", load="dribble_duel")
        ways.append([tick.world["robots"] for tick in busy(simulation, 40)])
    assert ways[0] == ways[1]


REFUSED: dict[str, tuple[str, dict[str, Any], str]] = {
    "a scene that is not there": ("load", {"load": "penlty"}, 'did you mean "penalty"'),
    "a file of the host's": ("load", {"load": "/etc/scene.toml"}, "the host reads no files"),
    "no scene": ("load", {}, "give one of them"),
    "a scene for a larger pitch": (
        "load",
        {"scene": Scene(description="x", robots=[robot("cyan1", 30.0, 0.0)])},
        "beyond the boundary",
    ),
    "two in one place": (
        "load",
        {"scene": Scene(description="x", robots=[robot("cyan1", 1.0, 2.0), robot("cyan2", 1.1, 2.0)])},
        "cyan1 at (1, 2) would be 0.39 m inside cyan2",
    ),
    "the ball in a robot": (
        "load",
        {"scene": Scene(description="x", robots=[robot("cyan1", 1.0, 2.0)], ball=SceneBall(x=1.1, y=2.0))},
        "cyan1 at (1, 2) would be 0.25 m inside the ball",
    ),
    "a type that nobody knows": (
        "load",
        {"scene": Scene(description="x", robots=[robot("cyan9", 1.0, 2.0, type="slwo")])},
        'cyan9 has the type "slwo"; did you mean "slow"',
    ),
    "a robot in another's frame": (
        "load",
        {"scene": Scene(description="x", robots=[robot("cyan1", 1.0, 2.0, type="keeper"), robot("cyan2", 1.0, 2.52)])},
        "cyan1 at (1, 2) would be",
    ),
    "a robot in a goal post": ("place", {"place": [Placement(body="cyan1", x=11.0, y=1.2)]}, "inside a goal"),
    "a robot on another": ("place", {"place": [Placement(body="cyan2", x=-10.5, y=0.1)]}, "inside cyan1"),
    "somebody who is not there": ("place", {"place": [Placement(body="cyan7", x=0, y=0)]}, "cyan7 is neither a robot"),
    "a flying robot": ("place", {"place": [Placement(body="cyan2", x=1, y=3, z=2)]}, "stands on the ground"),
    "a robot as fast as light": ("place", {"place": [Placement(body="cyan1", x=1, y=3, omega=3e8)]}, "at most 40 m/s"),
    "a ball in orbit": ("place", {"place": [Placement(body="ball", x=1, y=3, z=4e5)]}, "and 10 m high"),
    "a ball in the ground": ("place", {"place": [Placement(body="ball", x=1, y=3, z=0)]}, "its radius is 0.11 m"),
    "nobody": ("place", {}, "no body to place is named"),
    "a twelfth robot": (
        "add",
        {"robots": [robot(f"cyan{number}", number - 5.0, 5.0) for number in range(6, 13)]},
        "cyan has 12 robots; a side has at most 11",
    ),
    "a name twice": ("add", {"obstacles": [WALL.model_copy(update={"name": "cyan1"})]}, 'two bodies are named "cyan1"'),
    "a box to push in the boundary": (
        "add",
        {"obstacles": [WALL.model_copy(update={"name": "box", "mass": 5.0, "place": [3.0, 8.0], "heading": 0.1})]},
        "box would be at (3, 8), beyond the boundary",
    ),
    "an obstacle on a robot": ("add", {"obstacles": [WALL.model_copy(update={"place": [-10.5, 0.5]})]}, "inside wall"),
    "everybody": (
        "remove",
        {"remove": [f"{side}{number}" for side in Side for number in range(1, 6)]},
        "no robot would be left",
    ),
    "somebody who was not there": ("remove", {"remove": ["cyan8"]}, "cyan8 is neither a robot nor an obstacle"),
}


@pytest.mark.parametrize("operation, content, said", REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_is_refused_with_its_reason_and_nothing_happens(simulation, operation, content, said) -> None:
    reply = ask(simulation, operation, **content)
    assert not reply.accepted
    assert said in reply.reason
    tick = simulation.step({})
    assert not tick.applied["placements"] and not tick.applied["checkpoint"]
    assert not [event for event in tick.events if event.kind is EventKind.SCENE]


def test_several_deeds_between_two_ticks_are_done_in_their_order(simulation) -> None:
    assert ask(simulation, "remove", remove=["magenta3"]).accepted
    assert ask(simulation, "add", robots=[robot("magenta3", 5.0, 5.0)]).accepted
    assert ask(simulation, "place", place=[Placement(body="magenta3", x=6.0, y=5.0)]).accepted
    tick = simulation.step({})
    assert tick.world["robots"]["magenta3"]["x"] == approx(6.0)
    assert len([event for event in tick.events if event.kind is EventKind.SCENE]) == 3


def test_a_card_for_a_side_that_was_removed_is_refused(simulation) -> None:
    done(simulation, "remove", remove=[name for name in simulation.roster.names if name.startswith("magenta")])
    simulation.step({}, [RefereeAction(action=ActionName.START)])
    (reply,) = simulation.step({}, [RefereeAction(action=ActionName.YELLOW_CARD, side=Side.MAGENTA)]).replies
    assert not reply.accepted and reply.reason == "yellow_card: it is allowed for no robot of magenta: it has none"


def test_a_match_over_takes_no_more_scenes(simulation_of) -> None:
    simulation = simulation_of(duration=1.0)
    while not simulation.over:
        simulation.step({})
    assert ask(simulation, "load", load="penalty").reason == "the match is over"


def test_a_match_with_scenes_and_parameters_is_simulated_again_from_what_is_recorded(
    simulation_of, simulated_again
) -> None:
    simulation = simulation_of(teams__cyan__size=3, teams__magenta__size=2, referee__automatic=False)
    recorded = [simulation.now]
    operations: list[Callable[[], Any]] = [
        lambda: ask(simulation, "load", load="two_on_one"),
        lambda: simulation.handle_parameters(
            ParametersRequest(
                operation=ParameterOperation.SET, values={"ball.rolling_deceleration": 1.0, "drive.max_speed": 3.0}
            )
        ),
        lambda: ask(simulation, "place", place=[Placement(body="ball", x=1.0, y=2.0, vx=-1.0, vy=0.5)]),
        lambda: ask(simulation, "add", robots=[robot("cyan9", -3.0, -3.0, type="slow")], obstacles=[WALL]),
        lambda: ask(simulation, "remove", remove=["magenta2", "wall"]),
        lambda: simulation.handle_parameters(ParametersRequest(operation=ParameterOperation.RESET)),
        lambda: ask(simulation, "reset"),
        lambda: ask(simulation, "reset", to_match=True),
    ]
    for operation in operations:
        recorded += busy(simulation, 25)
        assert operation().accepted
    recorded += busy(simulation, 25)
    payloads = [tick.applied_encoded for tick in recorded]
    assert simulated_again(simulation.config, payloads) == [tick.applied["chain"] for tick in recorded]
    assert json.loads(payloads[-1])["episode"] == 4
