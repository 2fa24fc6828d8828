"""The radio: delay, loss and budget, the same for equal seeds."""

import json
from dataclasses import replace
from typing import Any

from pytest import approx

from schemas.command import Radio
from schemas.match_config import load_match
from schemas.profile import Radio as Air
from schemas.profile import load_profile
from sim_host.radio import RadioAir
from sim_host.sensing.streams import Streams
from sim_host.snapshot import Roster

ROSTER = Roster.of(load_match(None, {"teams.cyan.size": 3, "teams.magenta.size": 2}), load_profile("msl"))
TICK = 0.02
CLEAR = Air(delay=0.0, loss=0.0, budget=2.2e6)


def radio(air: Air = CLEAR, seed: int = 1) -> RadioAir:
    return RadioAir(air, ROSTER, TICK, Streams(seed))


def heard(air: RadioAir, tick: int) -> dict[str, Any]:
    return {name: json.loads(one) for name, one in zip(ROSTER.names, air.listen(tick), strict=True)}


def test_a_word_reaches_all_teammates_and_nobody_else() -> None:
    air = radio()
    assert air.say(0, "cyan1", Radio(role="keeper")) is None
    now = heard(air, 0)
    assert now["cyan2"]["cyan1"]["role"] == now["cyan3"]["cyan1"]["role"] == "keeper"
    assert now["cyan1"] == now["magenta1"] == now["magenta2"] == {}


def test_a_word_arrives_after_the_delay_with_its_age() -> None:
    air = radio(replace(CLEAR, delay=0.06))
    air.say(10, "cyan1", Radio(role="keeper"))
    assert heard(air, 12)["cyan2"] == {}
    assert heard(air, 13)["cyan2"]["cyan1"]["age"] == approx(0.06)
    assert heard(air, 20)["cyan2"]["cyan1"]["age"] == approx(0.20)


def test_the_newest_word_of_a_teammate_replaces_the_one_before() -> None:
    air = radio()
    for tick, role in enumerate(("keeper", "striker")):
        air.say(tick, "cyan1", Radio(role=role))
    assert heard(air, 1)["cyan2"]["cyan1"]["role"] == "striker"


def test_as_many_words_are_lost_as_the_profile_says_each_on_its_own_way() -> None:
    """2,000 words at a loss of 0.3: within 4 standard errors of 0.3 for each listener, and not the same words."""
    air = radio(replace(CLEAR, loss=0.3))
    lost: dict[str, list[bool]] = {"cyan2": [], "cyan3": []}
    for tick in range(2000):
        air.say(tick, "cyan1", Radio(intention=str(tick)))
        now = heard(air, tick)
        for name, record in lost.items():
            record.append(now[name].get("cyan1", {}).get("intention") != str(tick))
    for record in lost.values():
        assert sum(record) / 2000 == approx(0.3, abs=0.041)
    assert lost["cyan2"] != lost["cyan3"]


def test_a_word_beyond_the_teams_budget_is_refused_until_a_second_has_passed() -> None:
    word = Radio(intention="x" * 60)
    size = 8 * len(word.model_dump_json(exclude_defaults=True))
    air = radio(replace(CLEAR, budget=2.5 * size))
    assert air.say(0, "cyan1", word) is None
    assert air.say(1, "cyan2", word) is None
    assert "budget" in str(air.say(2, "cyan3", word))
    assert air.say(2, "magenta1", word) is None, "the other team has a budget of its own"
    assert air.say(50, "cyan3", word) is None


def test_the_league_s_budget_is_the_default() -> None:
    assert load_profile("msl").radio.budget == 2.2e6


def test_equal_seeds_lose_equal_words() -> None:
    def run(seed: int) -> list[bytes]:
        air = radio(replace(CLEAR, loss=0.5), seed)
        for tick in range(50):
            air.say(tick, "cyan1", Radio(intention=str(tick)))
        return air.listen(50)

    assert run(1) == run(1)
    assert [run(seed) for seed in range(5)] != [run(0)] * 5
