"""Attacks on the port of a host without credentials: it lives, the match goes on, and it reports what happened."""

import pytest

from schemas.game import EventKind
from sim_host.server.account_limits import OVER_RATE
from support.attacker import ATTACKS, RAW_ATTACKS
from support.process_story import SHORT_LIMIT

pytestmark = [pytest.mark.processes, pytest.mark.timeout(180)]

MEMORY_MB = 100


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
