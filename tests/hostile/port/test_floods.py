"""Floods on a host's port: the connection that floods is closed, and all others play on."""

import pytest

from schemas.access.accounts import Account
from schemas.game import EventKind
from schemas.messages.health import ConnectionHealth
from support.process_story import SHORT_LIMIT

pytestmark = [pytest.mark.processes, pytest.mark.timeout(180)]

MEMORY_MB = 100
FLOODS = [
    (Account.CYAN_COACH, "flood_of_orders"),
    (Account.CYAN_COACH, "flood_of_drives"),
    (Account.OPERATOR, "flood_of_orders"),
    (Account.OPERATOR, "flood_of_drives"),
    (Account.OPERATOR, "scene_queries"),
    (Account.OPERATOR, "parameter_queries"),
    (Account.REFEREE, "action_queries"),
    (Account.RECORDER, "flood_of_orders"),
    (Account.RECORDER, "fake_batches"),
    (Account.RECORDER, "histories"),
    (Account.VIEWER, "setup_queries"),
    (Account.VIEWER, "subscriptions"),
    (Account.VIEWER, "ten_deaf_readers"),
    (Account.MAGENTA, "huge_message"),
    (Account.MAGENTA, "malformed"),
]
"""Accounts, and floods on keys that they may write or read."""
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


@pytest.mark.parametrize(("account", "name"), FLOODS)
def test_a_flood_of_any_account_on_keys_that_it_may_use_leaves_the_match_to_the_others(guarded_target, account, name):
    target = guarded_target
    memory = target.memory_mb()
    attacker = target.attack(name, 0.5, account)
    attacker.popen.wait(SHORT_LIMIT)
    assert attacker.popen.returncode == 0, attacker.err
    play_on(target, ["cyan1", "cyan2", *(["magenta1"] if account is not Account.MAGENTA else [])])
    assert target.host.popen.poll() is None, target.host.err
    assert "Traceback" not in target.host.err
    assert target.memory_mb() - memory < MEMORY_MB


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
