"""The game free: a floor without ball and goals, things to push, zones, and a user's score."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pytest import approx

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.obstacle import ObstacleConfig
from schemas.config.roster import Placement
from schemas.config.task import GameName
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.messages.world import World
from schemas.soccer.game import ActionName, EventKind, TeamPhase
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation, TickResult
from support.free_match import free_match, scene
from touchline.matches.series.plan import plan_series
from touchline.play.play_match import InProcessMatch

GRAVITY = 9.81


@pytest.fixture
def play(tmp_path: Path) -> Iterator[Any]:
    """Make simulations of a match."""
    made = []

    def make(**overrides: Any) -> Simulation:
        made.append(Simulation(free_match(tmp_path, **{"task.score": "tally:plain"} | overrides)))
        return made[-1]

    yield make
    for one in made:
        one.close()


def drive(simulation: Simulation, ticks: int, **robots: Drive) -> TickResult:
    for _ in range(ticks):
        tick = simulation.now.tick
        simulation.step({name: Command(answers_tick=tick, drive=one) for name, one in robots.items()})
    return simulation.now


def box_of(tick: TickResult) -> Any:
    plain: World = validated(World, tick.world)
    return plain.obstacles["box"]


def push(simulation: Simulation, **velocity: float) -> None:
    """Set the box into motion where it lies free."""
    at = Placement(body="box", x=-5.0, y=3.0, **velocity)
    reply = simulation.handle_scene(SceneRequest(operation=SceneOperation.PLACE, place=[at]))
    assert reply.accepted, reply.reason


def test_there_is_no_ball_and_no_goal(play) -> None:
    simulation = play()
    tick = drive(simulation, 5, one=Drive(vx=1.0))
    assert tick.world["ball"] is None
    sight = Sight.decode(tick.sights["one"])
    assert (sight.ball, sight.holding, sight.kicker_ready, sight.game.phase) == (None, False, False, TeamPhase.PLAY)
    assert sight.obstacles[0].x == approx(1.0, abs=0.01)
    pitch = simulation.profile.field
    at_goal = {"x": pitch.goal_line + pitch.post, "y": pitch.goal_width / 2}  # where soccer has a post
    request = SceneRequest(operation=SceneOperation.PLACE, place=[Placement(body="one", **at_goal)])
    assert simulation.handle_scene(request).accepted
    drive(simulation, 100)
    assert simulation.now.world["robots"]["one"]["x"] == approx(at_goal["x"], abs=0.01)


def test_a_kick_is_refused(play) -> None:
    simulation = play()
    simulation.step({"one": Command(answers_tick=0, dribble=True, kick=Kick(mode=KickMode.GROUND, speed=3.0))})
    assert Sight.decode(simulation.now.sights["one"]).outcome.refused == ["the game has no ball"]


@pytest.mark.parametrize("speed, turning", [(1.5, 0.0), (0.0, 4.0), (1.0, 3.0)])
def test_friction_stops_what_is_pushed_as_its_coefficient_says(play, speed: float, turning: float) -> None:
    """All motion ends after √(v² + (k·ω)²) / (μ·g), with the radius of gyration k of the box."""
    simulation = play()
    push(simulation, vx=speed, omega=turning)
    gyration = math.sqrt((0.6**2 + 0.4**2) / 12)
    time = math.hypot(speed, gyration * turning) / (0.3 * GRAVITY)
    ticks = math.ceil(time / simulation.profile.time.tick)
    moving = box_of(drive(simulation, ticks - 2)).pushed
    assert math.hypot(moving.vx, gyration * moving.omega) > 0.0
    box = box_of(drive(simulation, 4))
    assert (box.pushed.vx, box.pushed.vy, box.pushed.omega) == (0.0, 0.0, 0.0)
    assert box.x + 5.0 == approx(speed * time / 2, rel=0.03, abs=0.005)
    assert box.heading == approx(turning * time / 2, rel=0.03, abs=0.01)


def test_a_robot_pushes_the_box_and_a_heavy_one_stays(play) -> None:
    light, heavy = (play(scene=scene(mass=mass, friction=0.9)) for mass in (3.0, 900.0))
    for simulation in (light, heavy):
        drive(simulation, 150, one=Drive(vx=1.0))
    moved, stayed = box_of(light.now), box_of(heavy.now)
    assert moved.x > 2.0 and abs(moved.y) < 0.2
    assert stayed.x - 1.0 < 0.1
    robot, half = light.now.world["robots"]["one"], 0.3
    assert moved.x - half - robot["x"] == approx(light.profile.robot.radius, abs=0.03)


def test_the_camera_sees_the_box_where_it_was_pushed_to(play) -> None:
    simulation = play()
    tick = drive(simulation, 150, one=Drive(vx=1.0))
    drive(simulation, 40, one=Drive())
    seen = Sight.decode(simulation.now.sights["two"]).obstacles
    box = box_of(simulation.now)
    assert box.x > box_of(tick).x - 0.01 > 1.5
    assert any((one.x, one.y) == approx((box.x, box.y), abs=0.02) for one in seen)


def test_a_reset_puts_the_box_back(play) -> None:
    simulation = play()
    drive(simulation, 100, one=Drive(vx=1.0))
    assert box_of(simulation.now).x > 1.2
    assert simulation.handle_scene(SceneRequest(operation=SceneOperation.RESET)).accepted
    box = box_of(drive(simulation, 1))
    assert (box.x, box.y, box.pushed.vx, simulation.episode) == (1.0, 0.0, 0.0, 2)


def test_another_change_of_the_scene_leaves_the_box_as_it_moves(play) -> None:
    simulation = play()
    push(simulation, vx=2.0)
    before = box_of(drive(simulation, 5))
    post = ObstacleConfig(name="post", shape="cylinder", place=[3.0, -3.0], radius=0.2, height=1.0)
    assert simulation.handle_scene(SceneRequest(operation=SceneOperation.ADD, obstacles=[post])).accepted
    after = box_of(drive(simulation, 1))
    assert after.pushed.vx == approx(before.pushed.vx - 0.3 * GRAVITY * simulation.profile.time.tick, rel=1e-6)
    assert set(simulation.now.world["obstacles"]) == {"box", "post"}


def test_the_score_remembers_draws_and_ends_the_match(tmp_path: Path) -> None:
    one, again = (_played(free_match(tmp_path, seed=seed)) for seed in (3, 3))
    other = _played(free_match(tmp_path, seed=4))
    assert one.now.tick == again.now.tick == 60 and one.over
    value = one.state.game_state(60, 1.2).value
    assert value == again.state.game_state(60, 1.2).value != other.state.game_state(60, 1.2).value
    assert 1.0 < value < 1.06  # one robot in the dock, and sixty random numbers
    assert [event.text for event in one.events if event.kind is EventKind.NOTE] == ["two"]
    (end,) = [event for event in one.events if event.kind is EventKind.FULL_TIME]
    assert end.text == f"ends after 1.20 s with the score {value:.6g}"


class _Played:
    def __init__(self, simulation: Simulation, events: list[Any]) -> None:
        self.now, self.state, self.over, self.events = simulation.now, simulation.state, simulation.over, events


def _played(config: MatchConfig) -> _Played:
    simulation, events = Simulation(config), []
    while not simulation.over:
        events += simulation.step({}).events
    simulation.close()
    return _Played(simulation, events)


def test_a_plain_number_is_a_score_and_the_duration_ends_the_match(play) -> None:
    simulation = play(**{"task.score": "tally:plain", "duration": 0.5})
    while not simulation.over:
        simulation.step({})
    assert simulation.now.time == approx(0.5)
    assert simulation.state.game_state(25, 0.5).value == approx(0.5)


def test_a_referee_s_action_is_refused(play) -> None:
    simulation = play()
    reply = simulation.step({}, [RefereeAction(action=ActionName.STOP)]).replies[0]
    assert (reply.accepted, reply.reason) == (False, "a free game has no referee")
    assert not simulation.over


def test_people_may_end_it(play) -> None:
    simulation = play()
    assert simulation.step({}, [RefereeAction(action=ActionName.END_GAME)]).replies[0].accepted
    assert simulation.over


def test_viewers_know_the_game_its_unit_and_its_zones(play) -> None:
    setup = play(**{"task.unit": "points"}).setup()
    again = type(setup).decode(setup.encode())
    assert (again.game, again.task.unit, again.task.zones[0].name) == (GameName.FREE, "points", "dock")
    assert "def count" not in setup.encode().decode()


def test_goals_are_not_compared_where_there_are_none(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match="a series counts goals; measure it with touchline experiment"):
        plan_series(free_match(tmp_path), [1])


FAULTS = {
    "an unknown game": ({"game": "chess"}, "game is 'chess'; one of soccer, free"),
    "no table": ({"task": None}, 'task is missing; the game "free" needs one'),
    "a side without robots": ({"task.side": "magenta"}, "task.side is magenta, which has no robots; name the other"),
    "no duration": ({"duration": None}, 'duration is missing; the game "free" needs one'),
    "no scene": ({"scene": None}, 'scene is missing; the game "free" needs one'),
    "no such module": ({"task.score": "nothing:count"}, 'task.score is "nothing:count"; there is no nothing.py in '),
    "no such function": ({"task.score": "tally:cuont"}, 'has no function cuont; did you mean "count"'),
    "no function": ({"task.score": "tally"}, "task.score is 'tally'; write .module:function"),
    "no Python": ({"program": "def count(:"}, r"invalid syntax \(.*tally.py, line 1\)"),
    "a zone of two shapes": (
        {"task.zones": [{"name": "a", "place": [0, 0], "radius": 1.0, "size": [1, 1]}]},
        "give radius or size",
    ),
    "two zones of a name": (
        {"task.zones": [{"name": "a", "place": [0, 0], "radius": 1.0}] * 2},
        'two zones are named "a"',
    ),
    "friction of what stands fast": ({"scene": scene(mass=None)}, "friction is for an obstacle with a mass"),
}


@pytest.mark.parametrize("changes, said", FAULTS.values(), ids=FAULTS)
def test_a_fault_of_the_match_file_is_one_line_with_its_place(
    tmp_path: Path, changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(TouchlineError, match=said) as raised:
        free_match(tmp_path, **changes)
    assert "\n" not in str(raised.value) and "task.toml" in str(raised.value)


def test_a_score_in_another_encoding_is_one_line_with_its_file(tmp_path: Path) -> None:
    (tmp_path / "task.toml").write_text('[task]\nscore = "tally:count"\n')
    (tmp_path / "tally.py").write_bytes("# café\n".encode("latin-1"))
    with pytest.raises(TouchlineError, match=r"task.toml: task.score is .* can't decode byte 0xe9 .*tally.py"):
        load_match(tmp_path / "task.toml")


RUNTIME = {
    "raises": (
        "return 1 / (now.tick - 3)",
        "it raised ZeroDivisionError: division by zero .tally.py, line 2. at tick 3",
    ),
    "NaN": ("return float('nan')", "at tick 1 it returned nan; return a finite number, or a Score"),
    "a text": ("return 'good'", "at tick 1 it returned 'good'"),
    "events that are a text": (
        "import touchline; return touchline.Score(1.0, events='box 2 is delivered')",
        "at tick 1 its events are 'box 2 is delivered'; return a list of sentences",
    ),
    "events that are a number": (
        "import touchline; return touchline.Score(1.0, events=3)",
        "at tick 1 its events are 3; return a list of sentences",
    ),
    "a memory that is no JSON": (
        "import touchline; return touchline.Score(1.0, memory=now)",
        "its memory is no JSON: Object of type Moment",
    ),
}


@pytest.mark.parametrize("body, said", RUNTIME.values(), ids=RUNTIME)
def test_a_fault_of_the_score_is_one_line_with_its_place(tmp_path: Path, body: str, said: str) -> None:
    simulation = Simulation(free_match(tmp_path, f"def count(now):\n    {body}\n"))
    with pytest.raises(TouchlineError, match='task.score is "tally:count"; ' + said):
        while not simulation.over:
            simulation.step({})
    simulation.close()


def test_a_score_may_be_any_number_of_numpy(tmp_path: Path) -> None:
    simulation = Simulation(free_match(tmp_path, "import numpy\ndef count(now):\n    return numpy.float32(0.5)\n"))
    simulation.step({})
    assert type(simulation.state.value) is float and simulation.state.value == 0.5
    simulation.close()


ROOT = Path(__file__).parents[3]


def test_the_coverage_example_has_at_most_120_lines_and_names_nothing_of_soccer() -> None:
    texts = [
        (ROOT / "examples" / "coverage" / name).read_text() for name in ("coverage.toml", "covered.py", "rover.py")
    ]
    assert sum(len(text.splitlines()) for text in texts) <= 120
    assert not [word for word in ("soccer", "ball", "goal_line", "kick", "referee") for text in texts if word in text]


def test_the_coverage_example_covers_its_floor() -> None:
    folder = ROOT / "examples" / "coverage"
    match = InProcessMatch(load_match(folder / "coverage.toml"), brain_folder=folder, chained=False)
    while not match.simulation.over:
        match.step()
    state = match.simulation.state.game_state(0, 0.0)
    match.close()
    assert state.value >= 0.95 and state.clock < 150.0
