"""Attacks on the port of a host without credentials: it lives, the match goes on, and it reports what happened."""

import pytest

from schemas.bus.zenoh.bus import open_client
from schemas.game import EventKind
from schemas.messages.setup import SetupRequest
from schemas.process.clock import WallClock
from schemas.topics import SETUP
from sim_host.server.account_limits import OVER_RATE
from support.attacker import ATTACKS, RAW_ATTACKS
from support.process_story import SHORT_LIMIT

pytestmark = [pytest.mark.processes, pytest.mark.timeout(180)]

MEMORY_MB = 100
FALSE_MS = 390.0
"""Time by which false time stamps are ahead."""


@pytest.mark.parametrize("name", [*ATTACKS, *RAW_ATTACKS])
def test_the_match_goes_on_during_and_after_the_attack(target, attack, name):
    memory, before = target.memory_mb(), target.watcher.tick
    attacker = attack(name)
    assert attacker.popen.returncode == 0, attacker.err
    assert target.host.popen.poll() is None, target.host.err
    assert target.watcher.tick > before + 20
    assert "Traceback" not in target.host.err
    assert target.memory_mb() - memory < MEMORY_MB
    if name not in ("flood", "flood_of_names", "malformed"):
        target.watcher.until(lambda one: one.robot("cyan1").answering, "answers of cyan1")
    target.watcher.until(lambda one: one.robot("magenta1").answering, "answers of magenta1")


def test_a_new_client_gets_in_while_a_thousand_half_open_connections_are_held(target):
    attacker = target.attack("half_open", SHORT_LIMIT)
    target.watcher.for_ticks(50)
    with open_client(target.config.name, WallClock(), target.endpoint, SHORT_LIMIT) as bus:
        setup = bus.query(SETUP, SetupRequest(), timeout=SHORT_LIMIT).result(SHORT_LIMIT)
    assert setup.match == target.config.name
    assert attacker.popen.poll() is None, attacker.err
    attacker.end()


def test_false_time_stamps_of_one_client_do_not_lengthen_the_latency_of_others(target):
    attacker = target.attack("false_times", SHORT_LIMIT)
    before = len(target.watcher.healths)
    target.watcher.until(lambda one: len(one.healths) > before + 12, "reports of three seconds")
    latencies = [health.robots["magenta1"].latency_ms for health in target.watcher.healths[before + 4 :]]
    assert attacker.popen.poll() is None, attacker.err
    attacker.end()
    assert min(latency for latency in latencies if latency is not None) < FALSE_MS / 2


def test_tokens_without_a_name_are_named_in_health(target, attack):
    attack("strange_tokens")
    target.watcher.until(
        lambda one: one.healths[-1].accounts["alive/recorder/*"].dropped, "a count of tokens without a name"
    )


def test_silent_and_slow_recorders_are_not_waited_for(target, attack):
    attack("silent_recorders")
    attacker = target.attack("slow_recorder", 3.0)
    target.watcher.until(lambda one: "slow" in one.healths[-1].recorders, "the slow recorder")
    target.watcher.for_ticks(400)
    target.watcher.until(lambda one: one.healths[-1].recorders.get("slow", 999) > 250, "a recorder that is far behind")
    attacker.popen.wait(SHORT_LIMIT)


def test_who_floods_is_cut_off_and_named(target):
    attacker = target.attack("steady_flood", SHORT_LIMIT)
    target.watcher.until(
        lambda one: one.healths[-1].accounts["robot/cyan1/command"].cut_off, "the cut of the flooded key"
    )
    attacker.end()
    health = target.watcher.healths[-1]
    assert health.accounts["robot/cyan1/command"].dropped[OVER_RATE] > 0
    assert not health.accounts["robot/magenta1/command"].cut_off
    events = [event.text for event in target.watcher.events if event.kind is EventKind.AGENT]
    assert any(text.startswith("robot/cyan1/command is cut off: ") for text in events)
    assert "robot/cyan1/command is cut off" in target.host.err
    target.watcher.for_ticks(50)
    target.watcher.until(lambda one: one.robot("magenta1").answering, "answers of magenta1")
