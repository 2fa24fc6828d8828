"""The panel of a match in a terminal: its rows, at any height."""

import pytest

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.orders import OrderBook
from runtime.bus.contract import Bus
from schemas.messages.coach import ActiveOrder, CoachMode, CoachOrder, CoachTest
from schemas.messages.health import Health, RobotHealth
from schemas.messages.radio import Belief, Radio
from schemas.messages.setup import Setup, TaskSetup
from schemas.messages.soccer.game import DisciplinaryRecord, GameEvent, GameState, RobotQuestion
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.side import Side
from schemas.soccer.game import ActionName, EventKind, OffField, Phase, Score
from schemas.topics import BELIEF, EVENT, HEALTH, STATE, WORLD
from schemas.wire.part_faults import validated
from support.in_process_bus import SharedState
from support.messages import make_setup
from support.stepped_clock import SteppedClock
from touchline.launch.terminal.panel import ARROWS, head, orders, panel, robots


@pytest.fixture(scope="module")
def setup() -> Setup:
    return make_setup()


def robot(x: float, y: float, heading: float = 0.0, **more: object) -> RobotTruth:
    return validated(
        RobotTruth,
        {"x": x, "y": y, "z": 0.4, "heading": heading, "vx": 0.0, "vy": 0.0, "omega": 0.0, "holding": False, **more},
    )


def world(ball: tuple[float, float] = (0.0, 0.0), tick: int = 5, **bodies: RobotTruth) -> World:
    truth = BallTruth(x=ball[0], y=ball[1], z=0.11, vx=0.0, vy=0.0, vz=0.0)
    return World(tick=tick, time=tick * 0.02, robots=bodies, ball=truth)


def state(phase: Phase = Phase.PLAY, **more: object) -> GameState:
    return validated(GameState, {"tick": 5, "time": 0.1, "clock": 61.0, "phase": phase, **more})


@pytest.mark.parametrize(("heading", "arrow"), [(0.0, "→"), (1.57, "↑"), (3.14, "←"), (-3.14, "←"), (-0.8, "↘")])
def test_a_robot_shows_where_it_faces(setup: Setup, heading: float, arrow: str) -> None:
    assert len(ARROWS) == 8
    assert robots(setup, world(cyan4=robot(3.0, 1.0, heading)), {}, None, None)[3].plain.startswith(f"4{arrow}")


def test_a_robot_has_its_place_and_speed_in_its_row(setup: Setup) -> None:
    moving = robot(-3.25, 1.5, vx=3.0, vy=4.0)
    assert "-3.2   1.5  5.0 m/s" in robots(setup, world(cyan1=moving), {}, None, None)[0].plain


def test_rows_are_in_the_order_of_the_numbers_of_the_names(setup: Setup) -> None:
    """As on the page: a robot that is added to a running match, or left of a larger team, keeps its own."""
    teams = {side: team.replace(robots=[f"{side.value}{n}" for n in (1, 7, 10)]) for side, team in setup.teams.items()}
    few = setup.replace(teams=teams)
    there = world(**{name: robot(1.0, 2.0) for team in teams.values() for name in team.robots})
    rows = [row.plain for row in robots(few, there, {}, None, None)]
    assert [row.split("→")[0].strip() for row in rows] == ["1", "7", "10"] * 2
    assert len({row.index(" m/s") for row in rows}) == 1


@pytest.mark.parametrize("height", [1, 5, 12, 24, 40])
def test_a_panel_fits_its_height_and_says_how_many_robots_are_left_out(setup: Setup, height: int) -> None:
    medium = SharedState()
    host = medium.open_bus("friendly", SteppedClock())
    seen = MatchFollower(medium.open_bus("friendly", SteppedClock()), details=True)
    say(host, world(**{name: robot(1.0, 2.0) for team in setup.teams.values() for name in team.robots}), state())
    seen.update()
    rows = [row.plain for row in panel(seen, setup, height)]
    shown = sum(" m/s" in row for row in rows)
    assert 0 < len(rows) <= height
    if height == 12:
        assert f"{10 - shown} more robots: make the terminal higher" in rows
    assert (shown == 10) == (height >= 24)


def say(host: Bus, world: World, state: GameState) -> None:
    host.publisher(WORLD).put(world)
    host.publisher(STATE).put(state)


def test_a_panel_has_score_phase_events_and_the_health_of_the_host(setup: Setup) -> None:
    medium = SharedState()
    host = medium.open_bus("friendly", SteppedClock())
    seen = MatchFollower(medium.open_bus("friendly", SteppedClock()), details=True)
    say(host, world(cyan2=robot(1.0, 0.0)), state(Phase.THROW_IN, side=Side.MAGENTA, score=Score(cyan=2, magenta=1)))
    host.publisher(HEALTH).put(Health(tick=5, time=0.1, pace="x2", real_time_factor=1.98, late_ticks=3))
    goal = GameEvent(tick=4, time=0.08, clock=60.5, kind=EventKind.GOAL, rule="goal", text="goal for cyan by cyan3")
    host.publisher(EVENT).put(goal)
    word = Radio(role="striker", intention="shoot")
    host.publisher(BELIEF, side="cyan", robot="cyan2").put(Belief(tick=5, time=0.1, robot="cyan2", radio=word))
    seen.update()
    text = "\n".join(row.plain for row in panel(seen, setup, 40))
    for words in ("Simple  2 : 1  NuBot", "1:01.0", "throw in, NuBot", "goal for Simple by cyan3", "×1.98 x2  late 3"):
        assert words in text
    assert "striker: shoot" in text


def test_the_score_of_a_task_stands_beside_the_goals(setup: Setup) -> None:
    of_task = setup.replace(task=TaskSetup(score="a:b", unit="s"))
    assert "Simple  0 : 0  NuBot   score 6.74 s  " in head(of_task, state(value=6.74)).plain


def test_control_characters_of_a_robot_do_not_reach_the_terminal(setup: Setup) -> None:
    words = {"cyan2": Radio(role="\x1b[2J", intention="to\nnight")}
    rows = [row.plain for row in robots(setup, world(cyan2=robot(1.0, 0.0)), words, None, None)]
    assert any("\N{REPLACEMENT CHARACTER}[2J: to\N{REPLACEMENT CHARACTER}night" in row for row in rows)


def test_what_keeps_a_robot_from_playing_is_in_its_row(setup: Setup) -> None:
    standing = {"cyan3": DisciplinaryRecord(yellow=1, off_field=OffField.REPAIR, left=12.0)}
    health = Health(
        tick=5,
        time=0.1,
        pace="lockstep",
        real_time_factor=1.0,
        robots={
            "cyan1": RobotHealth(alive=True),
            "cyan2": RobotHealth(alive=True, answering=True, latency_ms=31.0),
            "cyan3": RobotHealth(alive=True, answering=True, latency_ms=2.0),
        },
    )
    there = world(cyan4=robot(0.0, 0.0, stuck=True), cyan5=robot(1.0, 1.0, holding=True))
    rows = [row.plain for row in robots(setup, there, {}, state(robots=standing), health)]
    assert rows[0].endswith("silent")
    assert rows[1].endswith("answers after 31 ms")
    assert rows[2].endswith("repair 12 s, 1 yellow")
    assert rows[3].endswith("stuck")
    assert "●" in rows[4]


def test_an_active_order_is_shown_with_the_robots_that_have_not_acknowledged_it() -> None:
    book = OrderBook()
    assert orders(book) == []
    told = CoachOrder(sequence=3, mode=CoachMode.TEST, test=CoachTest.PASS, robot_a="cyan2", robot_b="cyan3")
    book.update(Side.CYAN, ActiveOrder(tick=1, time=0.0, order=told, acknowledged={"cyan2": True, "cyan3": False}))
    press = CoachOrder(sequence=4, tactic="press")
    book.update(Side.MAGENTA, ActiveOrder(tick=1, time=0.0, order=press, acknowledged={"magenta1": True}))
    assert [row.plain for row in orders(book)] == [
        " cyan  test pass, cyan2, cyan3  not acknowledged by cyan3",
        " magenta  play: press",
    ]


def test_an_order_that_robots_refuse_is_shown_with_them_and_the_reason() -> None:
    book = OrderBook()
    given = CoachOrder(sequence=3, mode=CoachMode.TEST, test=CoachTest.MACHINE, robot_a="cyan2")
    told, refused = dict.fromkeys(("cyan1", "cyan2"), True), dict.fromkeys(("cyan1", "cyan2"), "unknown test: machine")
    book.update(Side.CYAN, ActiveOrder(tick=1, time=0.0, order=given, acknowledged=told, refused=refused))
    (row,) = orders(book)
    assert row.plain == " cyan  test machine, cyan2  refused by cyan1, cyan2: unknown test: machine"


def test_a_robot_that_a_side_has_to_name_is_asked_for_in_the_first_row(setup: Setup) -> None:
    sides = ["cyan1", "cyan2"]
    asked = RobotQuestion(action=ActionName.YELLOW_CARD, side=Side.CYAN, left=8.0, robots=sides, default="cyan2")
    line = head(setup, GameState(tick=1, time=0.0, phase=Phase.STOPPED, questions=[asked])).plain
    assert line.endswith("  Simple names the robot for: yellow card, else cyan2")
