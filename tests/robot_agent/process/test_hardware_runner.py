"""A brain on its robot's own hardware: sights at its own rate, with a host and without."""

import math
from dataclasses import replace

import pytest
from pytest import approx

from robot_agent.hardware.dummy import Dummy
from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from robot_agent.process.hardware_run import guarded_hardware
from robot_agent.process.hardware_runner import HardwareRunner, RunnerWithoutHost
from robot_agent.process.settings import AgentSettings, BodyOptions
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.messages.radio import Radio
from schemas.messages.sight import ReceivedRadio
from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.side import Side
from schemas.soccer.game import OffField, Phase, Score, TeamPhase
from schemas.topics import COMMAND, HARDWARE, SIGHT, STATE
from support.in_process_bus import SharedState
from support.messages import make_setup, make_sight
from support.stepped_clock import SteppedClock


class ToThePost:
    """Drives to the first body that it sees, and tells its mates where it is."""

    def __init__(self):
        self.seen = []

    def act(self, sight):
        self.seen.append(sight)
        me, post = sight.self, sight.obstacles[0]
        dx, dy = post.x - me.x, post.y - me.y
        c, s = math.cos(me.heading), math.sin(me.heading)
        drive = Drive(vx=c * dx + s * dy, vy=c * dy - s * dx)
        return Command(answers_tick=sight.tick, drive=drive, radio=Radio(self=me))


class Field:
    """Robots on hardware, on one bus and one clock."""

    def __init__(self, setup):
        self.setup, self.shared, self.clock = setup, SharedState(), SteppedClock()
        self.host = self.bus()

    def bus(self):
        return self.shared.open_bus("friendly", self.clock)

    def robot(self, name, *, host=False, clearance=None, **dummy):
        model = self.setup.model_of(name)
        hardware = Dummy(model, posts=((3.0, 1.0),), **dummy)
        guard = HardwareGuard(
            hardware, HardwareSettings(hardware="dummy", clearance=clearance), model, name, self.clock, armed=True
        )
        guard.start()
        return (HardwareRunner if host else RunnerWithoutHost)(guard, self.setup, self.bus(), ToThePost(), name)


@pytest.fixture
def field(setup):
    return Field(setup)


def play(ticks, *runners):
    for _ in range(ticks):
        for runner in runners:
            sight = runner.next_sight(None)
            if sight is not None:
                runner.answer(sight)


@pytest.mark.parametrize("name", ["cyan2", "magenta3"])
def test_an_unchanged_brain_drives_the_hardware_to_what_its_own_camera_sees(field, name):
    robot = field.robot(name, start=(-1.0, 0.5, 2.0))
    play(250, robot)
    assert robot.guard.sense().motion.x == approx(3.0, abs=0.1)
    sights = robot.brain.seen
    assert [one.tick for one in sights] == list(range(1, 251))
    assert sights[-1].time == approx(5.0)
    attack = 1 if name == "cyan2" else -1
    assert (sights[0].self.x, sights[0].obstacles[0].x) == (-attack * 1.0, attack * 3.0)
    assert sights[0].game.running and sights[0].game.phase is TeamPhase.PLAY
    assert sights[5].outcome.answers_tick == sights[4].tick


def test_hardware_that_never_measures_a_motion_is_named_once(field, capfd):
    robot, other = field.robot("cyan2"), field.robot("cyan3")
    sense = robot.guard.sense
    robot.guard.sense = lambda: replace(sense(), motion=None)
    play(200, robot, other)
    assert robot.brain.seen == []
    said = [line for line in capfd.readouterr().err.splitlines() if "sense has given no motion yet" in line]
    assert len(said) == 1 and "cyan2" in said[0]


def test_hardware_that_finds_a_fault_itself_is_quoted_as_it_is(setup, tmp_path):
    (tmp_path / "robot.toml").write_text('hardware = "replayed"\n[options]\nrecording = "none.mcap"\nrobot = "cyan1"\n')
    settings = AgentSettings(robot="cyan2", body=BodyOptions(hardware=str(tmp_path / "robot.toml")))
    fault = 'hardware is "replayed"; none.mcap: No such file or directory; give the path of a recording'
    with pytest.raises(TouchlineError, match=f"^{fault}$"), guarded_hardware(settings, setup, SteppedClock()):
        pass


def test_teammates_without_a_host_hear_each_other_and_nobody_else(field):
    robots = [field.robot(name) for name in ("cyan2", "cyan3", "magenta2")]
    play(3, *robots)
    heard = robots[1].brain.seen[-1].radio
    assert set(heard) == {"cyan2"}
    assert heard["cyan2"].self.x == robots[0].brain.seen[-1].self.x
    assert heard["cyan2"].age < 0.02
    robots[0].guard.stop()
    play(10, robots[1])
    assert robots[1].brain.seen[-1].radio["cyan2"].age > 0.15


def test_sights_commands_and_the_health_of_the_hardware_are_published_for_recorders(field):
    kept = [field.host.subscribe(topic) for topic in (SIGHT, COMMAND, HARDWARE)]
    robot = field.robot("cyan2")
    play(26, robot)
    sight, command, health = (one.receive().message() for one in kept)
    assert (sight.robot, command.answers_tick, health.robot) == ("cyan2", 1, "cyan2")
    while (received := kept[2].receive()) is not None:
        health = received.message()
    assert (health.devices["motion"].readings, health.calls["actuate"].calls) == (14, 13), "the second report"


def test_with_a_host_game_order_and_radio_are_its_and_the_body_is_the_robots_own(field):
    sights, commands = field.host.publisher(SIGHT, robot="cyan2"), field.host.subscribe(COMMAND)
    robot = field.robot("cyan2", host=True)
    play(3, robot)
    sights.put(make_sight(699))
    play(3, robot)
    assert robot.brain.seen == [] and commands.receive() is None, "it does not know yet which way it attacks"
    field.host.publisher(STATE).put(GameState(tick=1, time=0.02, phase=Phase.PLAY))
    radio = {"cyan4": ReceivedRadio(age=0.1, role="keeper")}
    sights.put(make_sight(700, at=(9.0, 9.0, 0.0), phase=TeamPhase.OUR_CORNER, radio=radio))
    play(3, robot)
    seen = robot.brain.seen
    assert (seen[0].self.x, seen[0].game.phase, seen[0].radio) == (0.0, TeamPhase.OUR_CORNER, radio)
    assert [one.tick for one in seen] == [700, 701, 702] and seen[-1].time == approx(14.04)
    assert [one.radio["cyan4"].age for one in seen] == approx([0.1, 0.12, 0.14])
    assert commands.receive().message().answers_tick == 700
    assert commands.receive() is None, "a sight of the host is answered once"
    sights.put(make_sight(703))
    play(1, robot)
    assert commands.receive().message().answers_tick == 703
    assert robot.brain.seen[-1].tick == 703
    robot.restart(ToThePost())  # the host plays another match
    sights.put(make_sight(1))
    play(3, robot)
    assert robot.brain.seen == []
    field.host.publisher(STATE).put(GameState(tick=1, time=0.02, phase=Phase.PLAY))
    sights.put(make_sight(1))
    play(2, robot)
    assert [(one.tick, one.time) for one in robot.brain.seen] == [(1, 0.02), (2, 0.04)]


def test_a_robot_that_gets_no_sights_of_its_host_any_more_is_not_asked(field):
    """It is off the field, or the host is gone."""
    robot = field.robot("cyan2", host=True)
    field.host.publisher(STATE).put(GameState(tick=1, time=0.02, phase=Phase.PLAY))
    field.host.publisher(SIGHT, robot="cyan2").put(make_sight(5))
    play(100, robot)
    assert 49 <= len(robot.brain.seen) <= 51
    robot.guard.watch()
    assert robot.guard.health().fell_back == 1


def test_with_a_clearance_the_robot_stops_before_what_it_drives_to_and_says_so(field):
    robot = field.robot("cyan2", clearance=0.3)
    play(400, robot)
    motion, reach = robot.guard.sense().motion, field.setup.model_of("cyan2").body.reach
    assert math.dist((motion.x, motion.y), (3.0, 1.0)) == approx(2 * reach + 0.3, abs=0.05)
    assert robot.guard.health().filtered > 100
    assert robot.brain.seen[-1].outcome.refused == ["drive: changed to keep the clearance"]


def test_when_sides_change_the_robot_attacks_the_other_way(field):
    sights, states = field.host.publisher(SIGHT, robot="cyan2"), field.host.publisher(STATE)
    robot = field.robot("cyan2", host=True, start=(2.0, 1.0, 0.0))
    for attacks in (1, -1):
        states.put(GameState(tick=1, time=0.02, phase=Phase.PLAY, cyan_attacks=attacks))
        sights.put(make_sight(1))
        play(1, robot)
        assert robot.brain.seen[-1].self.x == approx(attacks * 2.0, abs=0.1)


def test_a_robot_whose_localisation_fails_is_not_asked_and_falls_back(field, monkeypatch):
    robot = field.robot("cyan2")
    play(60, robot)
    asked, hardware = len(robot.brain.seen), robot.guard
    good = Dummy.sense
    monkeypatch.setattr(Dummy, "sense", lambda self, time: replace(good(self, time), time=math.nan))
    for _ in range(60):
        play(1, robot)
        hardware.watch()
    health = hardware.health()
    assert len(robot.brain.seen) - asked <= 11
    assert health.fell_back == 1 and "motion: a reading is not finite" in health.reason
    monkeypatch.undo()
    assert robot.guard.sense().motion.vx == 0.0


@pytest.fixture
def officiated():
    return Field(make_setup(**{"referee.mode": "manual"}))


def seen_game(robot):
    """What the brain was shown last."""
    game = robot.brain.seen[-1].game
    return game.phase, game.running


def test_under_manual_officiating_the_game_is_what_a_gateway_publishes_and_stopped_without_news(officiated, capsys):
    robot, states = officiated.robot("magenta2"), officiated.host.publisher(STATE)
    play(3, robot)
    assert seen_game(robot) == (TeamPhase.STOPPED, False)
    corner = GameState(tick=1, time=0.02, phase=Phase.CORNER, side=Side.CYAN, running=True, score=Score(cyan=2))
    states.put(corner)
    play(120, robot)
    assert seen_game(robot) == (TeamPhase.THEIR_CORNER, True)
    play(10, robot)
    assert seen_game(robot) == (TeamPhase.STOPPED, False), "the gateway is gone"
    assert robot.brain.seen[-1].game.their_score == 2
    states.put(corner)
    play(1, robot)
    assert seen_game(robot) == (TeamPhase.THEIR_CORNER, True)
    lines = capsys.readouterr().err.splitlines()
    stopped = "magenta2: the game is stopped: no gateway publishes it; start touchline coach bridge"
    assert lines == 2 * [stopped, "magenta2: the game is that of a gateway"]


def test_under_other_officiating_no_gateway_decides(field):
    robot = field.robot("cyan2")
    field.host.publisher(STATE).put(GameState(tick=1, time=0.02, phase=Phase.STOPPED))
    play(3, robot)
    assert seen_game(robot) == (TeamPhase.PLAY, True)


def test_a_robot_that_is_sent_off_is_not_asked_and_falls_back(officiated):
    robot, states = officiated.robot("cyan2"), officiated.host.publisher(STATE)
    records = {"cyan2": DisciplinaryRecord(off_field=OffField.REPAIR)}
    for off in ({}, records):
        states.put(GameState(tick=1, time=0.02, phase=Phase.PLAY, running=True, robots=off))
        play(12, robot)
        robot.guard.watch()
    assert len(robot.brain.seen) == 12 and robot.guard.health().fell_back == 1
