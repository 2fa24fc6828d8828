"""Which commands answer which sights."""

import math
from collections import Counter

import pytest

from robot_agent.ros2.answers import Answers, Fault
from robot_agent.ros2.velocity import Velocity
from schemas.messages.command import Drive, Kick, KickMode
from support.messages import TICK, make_sight

A, B = b"a" * 16, b"b" * 16


class Bench:
    """The answers of one robot, which a node drives, with what was reported."""

    def __init__(self, *, is_lockstep: bool = True, every: int = 1, is_driven: bool = True) -> None:
        self.reports: list[tuple[Fault, str]] = []
        self.answers = Answers(
            TICK, lambda *report: self.reports.append(report), Counter(), is_lockstep=is_lockstep, every=every
        )
        self.answers.is_driven = is_driven

    def see(self, tick: int, **more):
        return self.answers.see(make_sight(tick, **more))

    def send(self, tick: float | None = None, vx: float = 1.0, driver: bytes = A):
        """A command with the time of a tick as its stamp, or without a stamp."""
        stamp = 0 if tick is None else round(tick * TICK * 1e9)
        return self.answers.command(Velocity(stamp, vx, 0.5, 0.1), driver, "/team")

    @property
    def faults(self) -> list[Fault]:
        return [fault for fault, _ in self.reports]


def test_a_stamped_command_answers_the_sight_of_its_stamp():
    bench = Bench()
    assert bench.see(7) is None
    command = bench.send(7)
    assert (command.answers_tick, command.drive) == (7, Drive(vx=1.0, vy=0.5, omega=0.1))
    assert bench.reports == []


def test_a_command_without_a_stamp_answers_the_newest_sight_once():
    bench = Bench()
    bench.see(7)
    assert bench.send().answers_tick == 7
    assert bench.send() is None
    assert bench.send() is None
    assert bench.faults == [Fault.EXCESS]
    assert bench.answers.counts == {Fault.EXCESS: 2}
    bench.see(8)
    assert bench.send().answers_tick == 8


def test_a_late_command_answers_its_own_tick_and_the_newest_sight_still_waits():
    bench = Bench()
    bench.see(7)
    bench.see(8)
    assert bench.faults == [Fault.UNANSWERED]
    assert bench.send(7).answers_tick == 7
    assert bench.send(8).answers_tick == 8
    assert bench.faults == [Fault.UNANSWERED, Fault.LATE]


def test_a_stamp_from_the_future_is_named_and_brakes():
    bench = Bench()
    bench.see(7)
    command = bench.send(8)
    assert (command.answers_tick, command.drive) == (7, Drive())
    ((fault, sentence),) = bench.reports
    assert fault is Fault.FUTURE
    assert sentence == "/team stamps a command 0.020 s ahead of /clock; use_sim_time is off?"


@pytest.mark.parametrize("vx", [math.nan, math.inf, 1e9])
def test_numbers_that_are_no_velocity_are_named_and_brake(vx: float):
    bench = Bench()
    bench.see(7)
    assert bench.send(7, vx=vx).drive == Drive()
    ((fault, sentence),) = bench.reports
    assert fault is Fault.INVALID
    assert sentence.startswith("/team: ")


def test_a_stamp_before_the_match_is_named_and_brakes():
    bench = Bench()
    bench.see(7)
    assert bench.send(-1).drive == Drive()
    assert bench.reports == [(Fault.INVALID, "/team stamps a command with a time before the start of the match")]


def test_two_nodes_on_one_robot_are_named_and_it_brakes_until_one_is_left():
    bench = Bench()
    bench.see(1)
    assert bench.send(1).drive.vx == 1.0
    bench.see(2)
    assert bench.send(2, driver=B).drive == Drive()
    assert bench.send(2) is None
    assert bench.faults == [Fault.CONTESTED]
    seconds = 0.6
    last = 2 + round(seconds / TICK)
    for tick in range(3, last):
        bench.see(tick)
        command = bench.send(tick)
    assert command.drive.vx == 1.0


def test_without_a_node_every_sight_is_answered_by_a_brake():
    bench = Bench(is_driven=False)
    assert bench.see(3).drive == Drive()
    assert bench.reports == []


def test_when_the_last_node_leaves_the_sight_that_waits_is_answered_by_a_brake():
    bench = Bench()
    bench.see(3)
    assert bench.answers.driven(is_driven=False).answers_tick == 3
    assert bench.faults == [Fault.LEFT]
    assert bench.see(4).drive == Drive()


def test_nodes_that_answer_every_third_tick_drive_between_them_with_their_last_command():
    bench = Bench(every=3)
    answered = []
    for tick in range(7):
        command = bench.see(tick) or bench.send(tick, vx=1.0 + tick)
        answered.append((command.answers_tick, command.drive.vx))
    assert answered == [(0, 1.0), (1, 1.0), (2, 1.0), (3, 4.0), (4, 4.0), (5, 4.0), (6, 7.0)]


def test_in_real_time_nothing_is_missed_and_one_command_a_tick_counts():
    bench = Bench(is_lockstep=False)
    bench.see(1)
    bench.see(2)
    bench.see(3)
    assert bench.send(2).answers_tick == 2
    assert bench.send().answers_tick == 3
    assert bench.send() is None
    assert bench.faults == [Fault.EXCESS]


def test_before_the_first_sight_a_command_is_none():
    assert Bench().send() is None


def test_a_kick_goes_with_the_next_command_and_the_dribbler_stays_on():
    bench = Bench()
    bench.see(1, holding=True)
    bench.answers.dribble = True
    kick = Kick(mode=KickMode.GROUND, speed=5.0)
    assert bench.answers.kick(kick) == ""
    command = bench.send(1)
    assert (command.kick, command.dribble) == (kick, True)
    bench.see(2, holding=True)
    command = bench.send(2)
    assert (command.kick, command.dribble) == (None, True)


def test_a_kick_without_the_ball_or_with_an_empty_kicker_says_why():
    bench = Bench()
    bench.see(1)
    kick = Kick(mode=KickMode.GROUND, speed=5.0)
    assert bench.answers.kick(kick) == "the robot does not hold the ball"
    bench.see(2, holding=True, kicker_ready=False)
    assert bench.answers.kick(kick) == "the kicker is not charged"
