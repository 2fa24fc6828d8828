"""The radio in whole ticks: delay, jitter, loss and budget, the same for equal seeds."""

from dataclasses import replace
from typing import Any

from msgspec import to_builtins
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.sections import RadioChannel
from schemas.messages.radio import Radio
from schemas.wire.part import encode
from sim_host.match.radio import RadioAir
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import Roster

ROSTER = Roster.of(load_match(None, {"teams.cyan.size": 3, "teams.magenta.size": 2}), load_profile("msl"))
TICK = 0.02
CLEAR = RadioChannel(delay=0.0, jitter=0.0, loss=0.0, budget=2.2e6)


def radio(air: RadioChannel = CLEAR, seed: int = 1) -> RadioAir:
    return RadioAir(air, ROSTER, TICK, RandomStreams(seed))


def send(air: RadioAir, tick: int, sender: str, content: Radio) -> str | None:
    """Sends one message; why it was refused."""
    return air.send(tick, {sender: content}).get(sender)


def heard(air: RadioAir, tick: int) -> dict[str, Any]:
    return {name: to_builtins(one) for name, one in zip(ROSTER.names, air.receive(tick), strict=True)}


def test_a_radio_message_reaches_all_teammates_and_no_other_robot() -> None:
    air = radio()
    assert send(air, 0, "cyan1", Radio(role="keeper")) is None
    now = heard(air, 0)
    assert now["cyan2"]["cyan1"]["role"] == now["cyan3"]["cyan1"]["role"] == "keeper"
    assert now["cyan1"] == now["magenta1"] == now["magenta2"] == {}


def arrivals(air: RadioAir, words: int) -> dict[str, list[tuple[int, int]]]:
    """Receiver → (tick of sending, ticks until delivery) of cyan1's radio messages, one in every tick.

    A word that another has overtaken is never heard.
    """
    came: dict[str, list[tuple[int, int]]] = {"cyan2": [], "cyan3": []}
    for tick in range(words):
        send(air, tick, "cyan1", Radio(intention=str(tick)))
        now = heard(air, tick)
        for name, times in came.items():
            word = now[name].get("cyan1")
            if word is not None and (not times or times[-1][0] != int(word["intention"])):
                said = int(word["intention"])
                times.append((said, tick - said))
                assert word["age"] == approx((tick - said) * TICK)
    return came


def test_an_overtaken_radio_message_is_not_delivered() -> None:
    """A receiver keeps the newest message, so messages only get newer."""
    came = arrivals(radio(replace(CLEAR, jitter=0.2)), 500)
    for times in came.values():
        said = [tick for tick, _ in times]
        assert said == sorted(said) and 100 < len(said) < 400, "some were overtaken, some were not"


def test_a_changed_air_is_that_of_all_words_from_now_on() -> None:
    air = radio(replace(CLEAR, delay=0.2))
    send(air, 0, "cyan1", Radio(role="keeper"))
    air.change(CLEAR)
    send(air, 1, "cyan2", Radio(role="striker"))
    assert set(heard(air, 1)["cyan3"]) == {"cyan2"}
    assert set(heard(air, 10)["cyan3"]) == {"cyan1", "cyan2"}, "what was under way arrives as it would have"
    air.change(replace(CLEAR, loss=1.0))
    send(air, 11, "cyan2", Radio(role="defender"))
    assert heard(air, 40)["cyan3"]["cyan2"]["role"] == "striker"
    air.change(replace(CLEAR, budget=0.0))
    assert "budget" in str(send(air, 41, "cyan2", Radio(role="defender")))


def test_teammates_that_stay_in_the_roster_keep_the_radio_messages_they_received() -> None:
    word = Radio(intention="x" * 60)
    size = 8 * len(encode(word))
    air = radio(replace(CLEAR, delay=0.04, budget=3.0 * size))
    for tick, name in enumerate(("cyan1", "cyan2", "cyan3")):
        send(air, tick, name, word)
    air.receive(2)
    roster = Roster(("cyan2", "cyan1", "cyan9"), ROSTER.sides[:3], {}, ROSTER.models[:3])
    heir = air.with_roster(roster)
    now = [set(one) for one in heir.receive(3)]
    assert now == [{"cyan1"}, {"cyan2"}, set()], "one word heard before, one on its way"
    assert "budget" in str(send(heir, 4, "cyan9", word)), "the team has said what it has said"


def test_the_share_of_lost_radio_messages_is_the_profiles_on_each_link() -> None:
    """2,000 words at a loss of 0.3: within 4 standard errors of 0.3 for each listener, and not the same words."""
    air = radio(replace(CLEAR, loss=0.3))
    lost: dict[str, list[bool]] = {"cyan2": [], "cyan3": []}
    for tick in range(2000):
        send(air, tick, "cyan1", Radio(intention=str(tick)))
        now = heard(air, tick)
        for name, record in lost.items():
            record.append(now[name].get("cyan1", {}).get("intention") != str(tick))
    for record in lost.values():
        assert sum(record) / 2000 == approx(0.3, abs=0.041)
    assert lost["cyan2"] != lost["cyan3"]


def test_a_word_beyond_the_teams_budget_is_refused_until_a_second_has_passed() -> None:
    word = Radio(intention="x" * 60)
    size = 8 * len(encode(word))
    air = radio(replace(CLEAR, budget=2.5 * size))
    assert send(air, 0, "cyan1", word) is None
    assert send(air, 1, "cyan2", word) is None
    assert "budget" in str(send(air, 2, "cyan3", word))
    assert send(air, 2, "magenta1", word) is None, "the other team has a budget of its own"
    assert send(air, 50, "cyan3", word) is None


def test_the_budget_is_counted_to_the_byte() -> None:
    word = Radio(intention="x" * 60, role="ü")
    size = 8 * len(encode(word))
    enough, short = radio(replace(CLEAR, budget=3.0 * size)), radio(replace(CLEAR, budget=3.0 * size - 1.0))
    for air, last in ((enough, True), (short, False)):
        assert send(air, 0, "cyan1", word) is None and send(air, 1, "cyan2", word) is None
        assert (send(air, 2, "cyan3", word) is None) == last
    assert send(enough, 49, "cyan1", word) is not None, "within the same second"
    assert send(enough, 50, "cyan1", word) is None, "a second after the first"
