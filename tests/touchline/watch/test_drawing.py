"""The match drawn in a terminal: what stands where, at any size."""

import io

import pytest
from rich.console import Console
from rich.text import Text

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.orders import OrderBook
from schemas.bus.contract import Bus
from schemas.bus.in_process_bus import SharedState
from schemas.errors import TouchlineError
from schemas.game import EventKind, OffField, Phase, Point, Score
from schemas.messages.coach import ActiveOrder, CoachMode, CoachOrder, CoachTest
from schemas.messages.game import DisciplinaryRecord, GameEvent, GameState, RobotQuestion
from schemas.messages.health import Health, RobotHealth
from schemas.messages.radio import Belief, Radio
from schemas.messages.setup import Setup
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.process.clock import SteppedClock
from schemas.side import Side
from schemas.topics import BELIEF, EVENT, HEALTH, STATE, WORLD
from support.messages import make_setup
from touchline.commands.watch import watch_on
from touchline.watch.drawing import draw_match
from touchline.watch.panel import head, orders, robots
from touchline.watch.pitch import ARROWS, SIDES, field
from touchline.watch.scale import Scale

WIDTH, HEIGHT = 90, 30


@pytest.fixture(scope="module")
def setup() -> Setup:
    return make_setup()


def robot(x: float, y: float, heading: float = 0.0, **more: object) -> RobotTruth:
    return RobotTruth.model_validate(
        {"x": x, "y": y, "z": 0.4, "heading": heading, "vx": 0.0, "vy": 0.0, "omega": 0.0, "holding": False, **more}
    )


def world(ball: tuple[float, float] = (0.0, 0.0), tick: int = 5, **bodies: RobotTruth) -> World:
    truth = BallTruth(x=ball[0], y=ball[1], z=0.11, vx=0.0, vy=0.0, vz=0.0)
    return World(tick=tick, time=tick * 0.02, robots=bodies, ball=truth)


def state(phase: Phase = Phase.PLAY, **more: object) -> GameState:
    return GameState.model_validate({"tick": 5, "time": 0.1, "clock": 61.0, "phase": phase, **more})


def where(rows: list[Text], words: str) -> tuple[int, int]:
    """ProcessRow and column of some characters."""
    ((row, text),) = [(row, text.plain) for row, text in enumerate(rows) if words in text.plain]
    return row, text.index(words)


def test_robots_and_ball_stand_where_they_are(setup: Setup) -> None:
    """x to the right, y up, the centre mark in the middle."""
    rows = field(setup, world((-5.0, 3.0), cyan2=robot(0.0, 0.0), magenta3=robot(6.0, -4.0)), None, WIDTH, HEIGHT)
    middle, right = where(rows, "2→"), where(rows, "3→")
    ball = where(rows, "●")
    assert abs(middle[0] - HEIGHT / 2) <= 1 and abs(middle[1] + 1 - WIDTH / 2) <= 1
    scale = Scale.of(setup.pitch, WIDTH, HEIGHT)
    assert right[1] - middle[1] == pytest.approx(6.0 * scale.dots / 2, abs=1)
    assert right[0] - middle[0] == pytest.approx(4.0 * scale.dots / 4, abs=1)
    assert ball[0] < middle[0] and ball[1] < middle[1]


@pytest.mark.parametrize(("heading", "arrow"), [(0.0, "→"), (1.57, "↑"), (3.14, "←"), (-3.14, "←"), (-0.8, "↘")])
def test_a_robot_shows_where_it_faces(setup: Setup, heading: float, arrow: str) -> None:
    assert len(ARROWS) == 8
    assert where(field(setup, world(cyan4=robot(3.0, 1.0, heading)), None, WIDTH, HEIGHT), f"4{arrow}")


def test_sides_differ_in_colour_and_in_brightness(setup: Setup) -> None:
    rows = field(setup, world((3.0, 3.0), cyan2=robot(-3.0, 0.0), magenta2=robot(3.0, 0.0)), None, WIDTH, HEIGHT)
    row = rows[next(place for place, text in enumerate(rows) if "2→" in text.plain)]
    styles = [row.plain[span.start : span.end] for span in row.spans if span.style in SIDES.values()]
    assert styles == ["2→", "2→"]
    assert SIDES[Side.CYAN].color != SIDES[Side.MAGENTA].color


def test_a_restart_shows_how_far_opponents_stay(setup: Setup) -> None:
    spot = Point(x=-4.0, y=2.0)
    playing = field(setup, None, state(), WIDTH, HEIGHT)
    waiting = field(setup, None, state(Phase.FREE_KICK, side=Side.CYAN, spot=spot), WIDTH, HEIGHT)
    assert [row.plain for row in playing] != [row.plain for row in waiting]


@pytest.mark.parametrize("size", [(1, 1), (20, 5), (80, 24), (120, 40), (200, 60), (300, 20), (40, 100)])
def test_a_picture_fits_its_terminal(setup: Setup, size: tuple[int, int]) -> None:
    medium = SharedState()
    host = medium.open_bus("friendly", SteppedClock())
    seen = MatchFollower(medium.open_bus("friendly", SteppedClock()), details=True)
    say(host, world(cyan1=robot(-30.0, 2.0), magenta5=robot(3.0, 99.0)), state())
    seen.update()
    rows = draw_match(seen, setup, *size)
    assert 0 < len(rows) <= size[1]
    assert max(row.cell_len for row in rows) <= size[0]


def say(host: Bus, world: World, state: GameState) -> None:
    host.publisher(WORLD).put(world)
    host.publisher(STATE).put(state)


def test_a_picture_has_score_phase_events_and_the_health_of_the_host(setup: Setup) -> None:
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
    text = "\n".join(row.plain for row in draw_match(seen, setup, 140, 40))
    for words in ("Simple  2 : 1  NuBot", "1:01.0", "throw in, NuBot", "goal for Simple by cyan3", "×1.98 x2  late 3"):
        assert words in text
    assert "striker: shoot" in text


def test_control_characters_of_a_robot_do_not_reach_the_terminal(setup: Setup) -> None:
    words = {"cyan2": Radio(role="\x1b[2J", intention="to\nnight")}
    rows = [row.plain for row in robots(setup, world(cyan2=robot(1.0, 0.0)), words, None, None)]
    assert any("\N{REPLACEMENT CHARACTER}[2J: to\N{REPLACEMENT CHARACTER}night" in row for row in rows)


def test_what_keeps_a_robot_from_playing_stands_beside_it(setup: Setup) -> None:
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


def test_a_robot_that_a_side_has_to_name_is_asked_for_above_the_pitch(setup: Setup) -> None:
    asked = RobotQuestion(action="yellow_card", side=Side.CYAN, left=8.0, robots=["cyan1", "cyan2"], default="cyan2")
    line = head(setup, GameState(tick=1, time=0.0, phase=Phase.STOPPED, questions=[asked])).plain
    assert line.endswith("  Simple names the robot for: yellow card, else cyan2")


class HostOfTicks(SteppedClock):
    """Goes on by a tick whenever the watcher waits; after three ticks the host leaves."""

    __slots__ = ("host", "tick")

    def sleep_until(self, moment: float) -> None:
        super().sleep_until(moment)
        self.tick += 1
        if self.tick > 3:
            self.host.close()
        else:
            say(self.host, world(tick=self.tick, cyan2=robot(float(self.tick), 0.0)), state())


def test_a_match_is_drawn_until_its_host_goes_and_its_last_picture_stays(
    setup: Setup, monkeypatch: pytest.MonkeyPatch
) -> None:
    medium, clock = SharedState(), HostOfTicks()
    clock.host, clock.tick = medium.open_bus("friendly", SteppedClock()), 0
    clock.host.declare_alive("host", "host")
    monkeypatch.setattr("coach_gateway.match.host_client.HostClient.setup", lambda self: setup)
    out = io.StringIO()
    watch_on(medium.open_bus("friendly", clock), Console(file=out, force_terminal=True, width=120, height=30))
    last = out.getvalue().split("\x1b[?1049l")[-1]
    assert "1:01.0" in last and "2→" in last


def test_a_match_without_a_host_is_wrong_input() -> None:
    with pytest.raises(TouchlineError, match='match "cup": no process answers host/setup'):
        watch_on(SharedState().open_bus("cup", SteppedClock()), Console(file=io.StringIO()))
