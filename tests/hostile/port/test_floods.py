"""Floods on a host's port: the connection that floods is closed, and all others play on."""

import pytest

from schemas.access.accounts import Account
from schemas.game import EventKind
from schemas.messages.health import ConnectionHealth

pytestmark = [pytest.mark.processes, pytest.mark.timeout(180)]

NONE = ConnectionHealth()
ALL = ("cyan1", "cyan2", "magenta1")


def connections(listener):
    """The counts of connections from this machine."""
    newest = listener.healths[-1:]
    return newest[0].connections.get("127.0.0.1", NONE) if newest else NONE


def play_on(target, robots):
    target.watcher.for_ticks(50)
    for robot in robots:
        target.watcher.until(lambda one, robot=robot: one.robot(robot).answering, f"answers of {robot}")


def test_the_connection_that_floods_is_closed_and_its_team_and_the_other_play_on(guarded_target):
    target = guarded_target
    attacker = target.attack("flood", 60.0, Account.CYAN)
    target.watcher.until(lambda one: connections(one).closed == 1, "the end of the flooding connection")
    target.watcher.until(lambda one: connections(one).refused > 0, "a refusal of the same client")
    play_on(target, ALL)
    assert not any(account.cut_off for account in target.watcher.healths[-1].accounts.values())
    assert attacker.popen.poll() is None, attacker.err
    events = [event.text for event in target.watcher.events if event.kind is EventKind.AGENT]
    assert any(text.startswith("a connection from 127.0.0.1 is closed: ") for text in events)
    assert "above their limits: cyan" in target.host.err
    assert "magenta1 left" not in target.host.err
    assert "cyan2 left" not in target.host.err
    attacker.end()


def test_a_flood_that_comes_back_as_a_new_client_each_time_is_refused_most_of_the_time(guarded_target):
    target = guarded_target
    before = connections(target.watcher)
    attacker = target.attack("reconnecting_flood", 60.0, Account.CYAN)
    target.watcher.until(lambda one: connections(one).closed >= before.closed + 2, "the end of two connections")
    target.watcher.until(lambda one: connections(one).refused > before.refused + 5, "refusals")
    play_on(target, ["magenta1"])
    attacker.end()
    target.watcher.for_ticks(50)
    assert target.host.popen.poll() is None, target.host.err
    assert "Traceback" not in target.host.err
