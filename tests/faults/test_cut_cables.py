"""The network to the machine of a team is cut and restored while the match goes on."""

import math

import pytest

from support.faulty_match import CYAN, Match
from support.link_emulator import LinkConditions

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

SECOND = 50
"""Ticks of a second."""
BACK = 3 * SECOND
"""Ticks in which all robots play again; 50 on a machine of its own, and more where tests share the processor."""
CLOSED = 10 * SECOND
"""Ticks that Zenoh may take to close a link with unsent data, see docs/decisions.md: without load it takes none."""
REST = 13
"""Ticks in which a robot at 0.6 m/s is at rest: 0.25 s, and the tick in which its last command arrives."""


def cut(match: Match) -> None:
    match.net.impair("cyan", LinkConditions(is_cut=True))


def restore(match: Match) -> None:
    match.net.impair("cyan", LinkConditions())


@pytest.mark.parametrize(("seconds", "back"), [(3, BACK), pytest.param(15, BACK + CLOSED, marks=pytest.mark.long)])
def test_all_robots_of_a_team_play_again_after_a_cut(match: Match, seconds: int, back: int) -> None:
    """Also after 8 s, four times as long as the agents wait for a host that is gone."""
    restore(match)
    match.until_playing(*CYAN, since=match.log.tick)
    answers = match.log.robot("magenta1").answers
    first, last = match.after_fault(lambda: cut(match), seconds * SECOND, lambda: restore(match))
    assert match.until_playing(*CYAN, since=last) - last <= back
    assert match.log.robot("magenta1").answers - answers > (last - first) / 2, "the other team plays on"


def test_robots_play_again_after_their_cable_was_unplugged(match: Match) -> None:
    net = match.net
    _, last = match.after_fault(lambda: net.cut("cyan"), 4 * SECOND, lambda: net.restore("cyan"))
    assert match.until_playing(*CYAN, since=last) - last <= BACK


def test_a_robot_that_is_cut_off_is_at_rest_within_a_quarter_of_a_second(match: Match) -> None:
    restore(match)
    match.until_playing(*CYAN, since=match.log.tick)
    begin = len(match.log.applied)
    match.log.for_ticks(SECOND)
    first, _ = match.after_fault(lambda: cut(match), SECOND, lambda: restore(match))
    commanded = [one.tick for one in match.log.applied[begin:] if one.inputs["cyan2"].answers_tick is not None]
    silent_from = max(tick for tick in commanded if tick < first + SECOND // 2)
    speeds = {
        world.tick: math.hypot(world.robots["cyan2"].vx, world.robots["cyan2"].vy)
        for world in match.log.worlds[-5 * SECOND :]
    }
    assert speeds[silent_from] > 0.1
    assert speeds[silent_from + REST] < 0.02


def test_no_command_from_before_a_cut_is_applied_after_it(match: Match) -> None:
    """The watchdog's 0.2 s are ten ticks; TCP delivers all that was sent meanwhile, in a burst."""
    begin = len(match.log.applied)
    _, last = match.after_fault(lambda: cut(match), SECOND, lambda: restore(match))
    match.until_playing(*CYAN, since=last)
    late = [
        (one.tick, robot, command.drive)
        for one in match.log.applied[begin:]
        for robot, command in one.inputs.items()
        if command.answers_tick is not None and one.tick - command.answers_tick > 11
    ]
    assert not late


def test_robots_play_over_a_link_with_delay_jitter_loss_and_reordering(match: Match) -> None:
    match.net.impair("cyan", LinkConditions(delay_ms=20.0, jitter_ms=5.0, loss=0.01, reordering=0.01))
    match.log.for_ticks(SECOND)
    before = match.log.healths[-1]
    match.log.for_ticks(4 * SECOND)
    after = match.log.healths[-1]
    restore(match)
    for robot in CYAN:
        answers = after.robots[robot].answers - before.robots[robot].answers
        assert answers > (after.tick - before.tick) / 4
        assert not after.robots[robot].invalid
        assert after.robots[robot].latency_ms > 30.0, "the link is as bad as it should be"
