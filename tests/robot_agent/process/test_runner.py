import json
import pdb
from pathlib import Path

import pytest

from robot_agent.loading.brain_error import BrainError
from robot_agent.process.runner import Member, Runner, ask_setup, serve
from robot_agent.process.settings import FIRST_SIGHT_FAILED
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.topics import COMMAND, SETUP, SIGHT
from support.answers import answer_next
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


class Counting:
    """Answers differently every time it is asked."""

    def __init__(self):
        self.seen = []

    def act(self, sight):
        self.seen.append(sight.tick)
        return Command(answers_tick=sight.tick, drive=Drive(vx=0.1 * len(self.seen)))


class Raising:
    def act(self, sight):
        raise ZeroDivisionError("no ball, no plan")


@pytest.fixture
def seats():
    medium = SharedState()
    return medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())


@pytest.fixture
def played(seats):
    """Host side of one robot: what it sends sights with and reads commands from, and the robot's runner."""
    host, robot = seats
    commands = host.subscribe(COMMAND)
    runner = Runner(robot, Counting(), "cyan2")
    return host.publisher(SIGHT, robot="cyan2"), commands, runner


def test_a_sight_is_answered_with_the_brains_command(played, sight_of):
    sights, commands, runner = played
    sights.put(sight_of(4))
    assert answer_next(runner)
    received = commands.receive()
    assert received.key == "robot/cyan2/command"
    assert received.message() == Command(answers_tick=4, drive=Drive(vx=0.1))


def test_a_command_is_stamped_with_the_simulated_time_of_its_sight(played, sight_of):
    sights, commands, runner = played
    sights.put(sight_of(50))
    answer_next(runner)
    assert commands.receive().stamp.sim_ns == 1_000_000_000


def test_a_sight_that_comes_again_gets_the_same_bytes_and_the_brain_is_not_asked(played, sight_of):
    sights, commands, runner = played
    for _ in range(3):
        sights.put(sight_of(4))
        assert answer_next(runner)
    answers = [commands.receive() for _ in range(3)]
    assert len({(answer.payload, answer.stamp) for answer in answers}) == 1  # copies, none of which counts as lost
    assert runner.brain.seen == [4]
    assert (runner.answered, runner.repeated) == (1, 2)


def test_of_sights_that_wait_only_the_newest_is_answered(played, sight_of):
    sights, _, runner = played
    for tick in (1, 2, 3):
        sights.put(sight_of(tick))
    assert answer_next(runner)
    assert not answer_next(runner)
    assert runner.brain.seen == [3]


def test_the_sights_of_another_robot_are_not_answered(seats, played, sight_of):
    _, _, runner = played
    seats[0].publisher(SIGHT, robot="cyan3").put(sight_of(1, "cyan3"))
    assert not answer_next(runner)


def test_a_payload_that_is_no_sight_is_counted_and_skipped(played, sight_of, capsys):
    sights, commands, runner = played
    for payload in (b"{", b'{"tick":1}', b"\xff"):
        sights.put_payload(payload)
        assert not answer_next(runner)
    assert runner.invalid == 3
    assert commands.receive() is None
    assert capsys.readouterr().err.count("\n") == 1
    sights.put(sight_of(5))
    assert answer_next(runner)


def test_after_forgetting_an_equal_tick_is_a_new_sight(played, sight_of):
    sights, _, runner = played
    sights.put(sight_of(0))
    answer_next(runner)
    fresh = Counting()
    runner.restart(fresh)
    sights.put(sight_of(0))
    assert answer_next(runner)
    assert (fresh.seen, runner.repeated) == ([0], 0)


def test_without_a_host_the_setup_is_asked_for_until_patience_ends(seats):
    _, robot = seats
    with pytest.raises(TouchlineError, match=r"no host replied with the setup within 3 s .*--match"):
        ask_setup(robot, 3.0)
    assert robot.clock.now() >= 3.0


class Impatient(SteppedClock):
    """Half a second passes with each look."""

    def now(self):
        self.sleep_until(super().now() + 0.5)
        return super().now()


@pytest.fixture
def stage(setup, monkeypatch):
    """A host that answers every question for the setup at once, and a robot that never sleeps."""
    medium = SharedState()
    host, robot = medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", Impatient())
    host.declare_alive("host", "host")
    server = host.serve(SETUP)

    def query(topic, request, timeout=2.0):
        answer = type(robot).query(robot, topic, request, timeout)
        server.receive().reply(setup)
        return answer

    monkeypatch.setattr(robot, "query", query)
    monkeypatch.setattr("robot_agent.process.runner.IDLE_S", 0.0)
    return host, robot


@pytest.mark.parametrize(("answered", "status"), [(0, FIRST_SIGHT_FAILED), (3, 1)])
def test_a_brain_that_raises_ends_the_process_with_its_traceback(
    stage, sight_of, capsys, monkeypatch, answered, status
):
    host, robot = stage
    sights = host.publisher(SIGHT, robot="cyan2")
    monkeypatch.setattr(robot, "declare_alive", lambda kind, name: sights.put(sight_of(9 - answered)))
    commands = host.subscribe(COMMAND)

    class Late(Raising):
        def act(self, sight):
            if sight.tick == 9:
                return super().act(sight)
            sights.put(sight_of(sight.tick + 1))
            return Command(answers_tick=sight.tick)

    assert serve(robot, Member(robot, lambda setup: Late(), "cyan2", 1.0)) == status
    assert len(list(iter(commands.receive, None))) == answered
    report = capsys.readouterr().err
    place = place_in(Raising.act, 1)
    assert report.splitlines()[-1] == f"act raised at tick 9 {place}: ZeroDivisionError: no ball, no plan"
    assert report.count("no ball, no plan") == 2  # in the source line, and in the last one
    assert "in _think" not in report  # the traceback begins with the brain's own code


def test_a_robot_whose_bus_is_closed_ends_with_status_0_and_waits_for_no_host(stage, capsys, monkeypatch):
    _, robot = stage

    def closes() -> bool:
        robot.close()
        return False

    monkeypatch.setattr(robot, "connected", closes)
    assert serve(robot, Member(robot, lambda setup: Counting(), "cyan2", 60.0)) == 0
    assert capsys.readouterr().err == ""


def failure_of(seats, act, sight):
    """The report of a brain with this function as `act`."""
    brain = type("Some", (), {"act": act})()
    with pytest.raises(BrainError) as raised:
        Runner(seats[1], brain, "cyan2").answer(sight)
    return raised.value.report()


def place_in(act, line=0):
    """The place of a line of a function, counted from its first, as messages name it."""
    file = Path(__file__).relative_to(Path.cwd()) if Path(__file__).is_relative_to(Path.cwd()) else Path(__file__)
    return f"({file}, line {act.__code__.co_firstlineno + line})"


def test_a_brain_that_returns_none_is_reported_in_one_line_with_its_place(seats, sight_of):
    def act(self, sight):
        return None

    assert failure_of(seats, act, sight_of(4)) == f"act returned None at tick 4 {place_in(act)}; return a Command\n"


@pytest.mark.parametrize(("speed", "shown"), [(float("nan"), "nan"), (100.0, "100.0"), ("fast", "'fast'")])
def test_an_invalid_drive_is_reported_in_one_line_with_its_place_and_the_valid_range(seats, sight_of, speed, shown):
    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=speed))

    fault = f"drive.vx is {shown}; m/s from -20 to 20"
    assert failure_of(seats, act, sight_of(4)) == f"act failed at tick 4 {place_in(act, 1)}: {fault}\n"


def test_an_exception_of_a_library_is_reported_with_the_brains_line_that_called_it(seats, sight_of):
    def act(self, sight):
        return json.loads("no")

    report = failure_of(seats, act, sight_of(4))
    last = report.splitlines()[-1]
    assert last.startswith(f"act raised at tick 4 {place_in(act, 1)}: JSONDecodeError: Expecting value")
    assert "in raw_decode" in report


def test_the_cause_of_an_exception_is_reported_too(seats, sight_of):
    def act(self, sight):
        try:
            return {}["ball"]
        except KeyError as error:
            raise ValueError("no ball") from error

    report = failure_of(seats, act, sight_of(4))
    assert "KeyError: 'ball'" in report
    assert report.splitlines()[-1] == f"act raised at tick 4 {place_in(act, 4)}: ValueError: no ball"


def test_a_brain_that_ends_its_process_is_reported_as_one_that_raises(seats, sight_of):
    def act(self, sight):
        raise SystemExit(0)

    report = failure_of(seats, act, sight_of(4))
    assert report.splitlines()[-1] == f"act raised at tick 4 {place_in(act, 1)}: SystemExit: 0"


def test_a_debugger_that_finds_no_terminal_is_reported_with_the_remedy(seats, sight_of, monkeypatch):
    def act(self, sight):
        pdb.Pdb().set_trace()
        return Command(answers_tick=sight.tick)

    monkeypatch.setattr("builtins.input", lambda _prompt="": "EOF")
    report = failure_of(seats, act, sight_of(4)).splitlines()
    assert report[-2].startswith("act raised at tick 4 ") and "BdbQuit" in report[-2]
    assert "write breakpoint(), which it skips" in report[-1]


def test_a_sight_of_the_next_match_is_not_shown_to_the_brain_of_the_last(stage, sight_of, monkeypatch):
    host, robot = stage
    sights = host.publisher(SIGHT, robot="cyan2")
    built = []

    def host_is_replaced(kind, name):
        host.shared_state.count_token("friendly", ("friendly/host", "host"), -1)
        host.shared_state.count_token("friendly", ("friendly/host", "host"), +1)
        sights.put(sight_of(0))

    def build(setup):
        built.append(Counting())
        if len(built) == 2:
            sights.put(sight_of(1))
            monkeypatch.setattr(robot, "connected", lambda: False)
        return built[-1]

    monkeypatch.setattr(robot, "declare_alive", host_is_replaced)
    assert serve(robot, Member(robot, build, "cyan2", 3.0)) == 0
    assert [brain.seen for brain in built] == [[], [1]]


def test_a_host_that_is_gone_for_longer_than_patience_ends_the_process_with_status_0(stage, capsys, monkeypatch):
    host, robot = stage
    monkeypatch.setattr(robot, "declare_alive", lambda kind, name: host.close())
    assert serve(robot, Member(robot, lambda setup: Counting(), "cyan2", 3.0)) == 0
    assert "the host has been gone for 3 s" in capsys.readouterr().err


def test_when_the_host_comes_back_the_brain_is_built_anew_and_answers(stage, sight_of, monkeypatch):
    host, robot = stage
    sights = host.publisher(SIGHT, robot="cyan2")
    there = iter([False, False, True])
    built = []

    def build(setup):
        built.append(Counting())
        if len(built) == 2:
            sights.put(sight_of(0))
        return built[-1]

    monkeypatch.setattr(robot, "connected", lambda: next(there, False))
    assert serve(robot, Member(robot, build, "cyan2", 3.0)) == 0
    assert [brain.seen for brain in built] == [[], [0]]


def test_an_agent_is_seen_to_be_alive_under_its_robots_name(stage, monkeypatch):
    host, robot = stage
    watch = host.watch_alive()
    monkeypatch.setattr(robot, "connected", lambda: False)
    serve(robot, Member(robot, lambda setup: Counting(), "cyan2", 1.0))
    assert ("agent", "cyan2", True) in [(one.kind, one.name, one.alive) for one in iter(watch.receive, None)]
