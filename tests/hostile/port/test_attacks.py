"""Attacks on the port of a host: it lives, its memory is bounded, the match goes on, and the account is named."""

import pytest

from runtime.access.accounts import Account
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.messages.setup import SetupRequest
from schemas.soccer.game import EventKind
from schemas.topics import SETUP
from support.attacker import ATTACKS, RAW_ATTACKS
from support.process_story import SHORT_LIMIT

pytestmark = [pytest.mark.processes, pytest.mark.timeout(180)]

MEMORY_MB = 100
ON_CYAN1 = ("flood", "flood_of_names", "flood_of_drives", "malformed")
"""Attacks on the key of cyan1, whose own commands are then over the limit, too."""
SHORT = ("flood", "garbage", "huge_message", "long_keys", "malformed", "strange_tokens", "wildcard_puts")
"""An attack of each kind: messages, bytes, sizes, keys, payloads, tokens, and keys with wildcards."""
FLOODS = [
    (Account.CYAN_COACH, "flood_of_orders"),
    (Account.VIEWER, "setup_queries"),
    *(
        pytest.param(account, name, marks=pytest.mark.long)
        for account, name in (
            (Account.CYAN_COACH, "flood_of_drives"),
            (Account.OPERATOR, "scene_queries"),
            (Account.OPERATOR, "parameter_queries"),
            (Account.REFEREE, "action_queries"),
            (Account.RECORDER, "histories"),
            (Account.VIEWER, "deaf_readers"),
            (Account.MAGENTA, "huge_message"),
        )
    ),
]
"""Accounts, and floods on keys that they may write or read; what each may not is in `test_accounts.py`."""


def carry_out(target, name, robots, account=None):
    """Carry an attack out to its end, while the match has to go on with these robots; returns the growth in MB."""
    memory, before = target.memory_mb(), target.watcher.tick
    attacker = target.attack(name, 0.5, account)
    attacker.popen.wait(SHORT_LIMIT)
    assert attacker.popen.returncode == 0, attacker.err
    target.watcher.for_ticks(50)
    assert target.host.popen.poll() is None, target.host.err
    assert target.watcher.tick > before + 50
    assert "Traceback" not in target.host.err
    for robot in robots:
        target.watcher.until(lambda one, robot=robot: one.robot(robot).answering, f"answers of {robot}")
    return target.memory_mb() - memory


@pytest.mark.parametrize(
    "name",
    [*SHORT, *(pytest.param(one, marks=pytest.mark.long) for one in (*ATTACKS, *RAW_ATTACKS) if one not in SHORT)],
)
def test_without_credentials_the_match_goes_on_during_and_after_the_attack(target, name):
    robots = ["magenta1"] if name in ON_CYAN1 else ["cyan1", "magenta1"]
    assert carry_out(target, name, robots) < MEMORY_MB


@pytest.mark.parametrize(("account", "name"), FLOODS)
def test_a_flood_of_any_account_on_keys_that_it_may_use_leaves_the_match_to_all_robots(guarded_target, account, name):
    assert carry_out(guarded_target, name, ["cyan1", "cyan2", "magenta1"], account) < MEMORY_MB


def test_a_team_that_floods_its_own_key_is_named_and_forfeits_and_the_host_ends_in_good_order(guarded_target):
    """The host of the tests before, which goes on until this one."""
    target = guarded_target
    memory = target.memory_mb()
    attacker = target.attack("flood", SHORT_LIMIT, Account.CYAN)
    most = memory
    while target.host.popen.poll() is None:
        most = max(most, target.memory_mb_or(most))
        target.watcher.update()
    attacker.end()
    assert target.host.popen.returncode == 0, target.host.err
    assert "Traceback" not in target.host.err
    assert "cyan is over its limit of messages" in target.host.err
    assert most - memory < MEMORY_MB
    forfeits = [event for event in target.watcher.events if event.kind is EventKind.FORFEIT]
    assert [event.side for event in forfeits] == ["cyan"]


def test_a_new_client_gets_in_while_a_thousand_half_open_connections_are_held(target):
    attacker = target.attack("half_open", SHORT_LIMIT)
    target.watcher.for_ticks(50)
    with open_client(target.config.name, WallClock(), target.endpoint, SHORT_LIMIT) as bus:
        setup = bus.query(SETUP, SetupRequest(), timeout=SHORT_LIMIT).result(SHORT_LIMIT)
    assert setup.match == target.config.name
    assert attacker.popen.poll() is None, attacker.err
    attacker.end()
