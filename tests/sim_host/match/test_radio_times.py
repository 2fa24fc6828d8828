"""The radio at exact times: ages in sights follow the closed forms of docs/physics.md."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

from schemas.config.sections import RadioChannel
from schemas.messages.radio import Radio
from schemas.messages.sight import ReceivedRadio
from schemas.side import Side
from sim_host.match.radio import RadioAir
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import Roster

TICK = 0.02
EXACT = RadioChannel(delay=0.0, jitter=0.0, loss=0.0, budget=1e9, model="separate")
COUNT = 3000
"""Messages of which a distribution is measured."""
KOLMOGOROV = 1.95 / math.sqrt(COUNT)
"""Distance of an empirical distribution from the true one that is exceeded once in a thousand samples."""


def roster(cyan: Sequence[str] = ("cyan1", "cyan2", "cyan3"), magenta: Sequence[str] = ("magenta1",)) -> Roster:
    names = (*cyan, *magenta)
    return Roster(names, (Side.CYAN,) * len(cyan) + (Side.MAGENTA,) * len(magenta), {}, ())


def radio(air: RadioChannel = EXACT, seed: int = 1, of: Roster | None = None) -> RadioAir:
    return RadioAir(air, of or roster(), TICK, RandomStreams(seed))


def first_ages(air: RadioChannel, seed: int = 1) -> dict[str, list[float]]:
    """Receiver → age of each of cyan1's messages in the first sight that has it; messages far enough apart."""
    one, apart = radio(air, seed), math.ceil((air.delay + air.jitter) / TICK) + 2
    ages: dict[str, list[float]] = {"cyan2": [], "cyan3": []}
    for tick in range(1, COUNT * apart + 1):
        if tick % apart == 1:
            one.send(tick, {"cyan1": Radio(intention=str(tick))})
        now = dict(zip(roster().names, one.receive(tick), strict=True))
        for name, its in ages.items():
            heard = now[name].get("cyan1")
            if (
                heard is not None
                and heard.intention == str(tick - (tick - 1) % apart)
                and len(its) <= (tick - 1) // apart
            ):
                its.append(heard.age)
    return ages


def cdf_of_sum(jitter: float) -> Callable[[float], float]:
    """The distribution of U·jitter + W, U uniform in [0, 1] and W, the wait for the next sight, uniform in a tick."""

    def integral(x: float) -> float:
        return max(x, 0.0) ** 2 / 2

    def cdf(x: float) -> float:
        if jitter == 0.0:
            return min(max(x / TICK, 0.0), 1.0)
        corners = integral(x) - integral(x - jitter) - integral(x - TICK) + integral(x - jitter - TICK)
        return corners / (jitter * TICK)

    return cdf


@pytest.mark.parametrize("delay", [0.0, 0.02, 0.033])
@pytest.mark.parametrize("jitter", [0.0, 0.006, 0.02, 0.05])
def test_the_age_in_the_first_sight_is_delay_and_jitter_and_the_wait_for_a_sight(delay: float, jitter: float) -> None:
    """Mean delay + jitter/2 + tick/2, variance jitter²/12 + tick²/12, and the whole distribution (Kolmogorov)."""
    for ages in first_ages(replace(EXACT, delay=delay, jitter=jitter)).values():
        assert len(ages) == COUNT
        sigma = math.sqrt((jitter**2 + TICK**2) / 12)
        assert np.mean(ages) == approx(delay + jitter / 2 + TICK / 2, abs=4 * sigma / math.sqrt(COUNT))
        assert np.std(ages) == approx(sigma, rel=0.06)
        assert min(ages) >= delay - 1e-4 and max(ages) <= delay + jitter + TICK + 1e-4
        cdf, ranks = cdf_of_sum(jitter), np.arange(COUNT) / COUNT
        expected = np.array([cdf(age - delay) for age in sorted(ages)])
        assert max(np.max(expected - ranks), np.max(ranks + 1 / COUNT - expected)) < KOLMOGOROV


def test_receivers_of_a_message_draw_their_own_jitter_and_read_one_time_of_sending() -> None:
    """The first ages differ by whole ticks: it left once, and is in another sight."""
    ages = first_ages(replace(EXACT, jitter=0.02))
    difference = (np.array(ages["cyan2"]) - np.array(ages["cyan3"])) / TICK
    assert difference == approx(difference.round(), abs=0.011)
    assert {-1, 0, 1} == set(difference.round())


def test_an_age_grows_by_the_tick_in_every_sight() -> None:
    one = radio(replace(EXACT, delay=0.03))
    one.send(7, {"cyan1": Radio(role="keeper")})
    ages = [heard["cyan1"].age for tick in range(7, 40) if (heard := list(one.receive(tick))[1])]
    assert np.diff(ages) == approx(TICK, abs=1e-4)
    assert 0.03 <= ages[0] < 0.05, "the first sight at or after its arrival"


def cyan_hears(air: RadioChannel, magenta: Sequence[str], talking: int, seed: int) -> list[dict[str, ReceivedRadio]]:
    """What cyan2 receives in each tick while the first `talking` robots of magenta send as well."""
    one = radio(air, seed, roster(magenta=magenta))
    heard = []
    for tick in range(1, 120):
        senders = ("cyan1", "cyan3", *magenta[:talking])
        one.send(tick, {name: Radio(intention=f"{name} {tick}") for name in senders})
        heard.append(list(one.receive(tick))[1])
    return heard


@pytest.mark.parametrize("model", ["separate", "ticks"])
@pytest.mark.parametrize("seed", range(4))
def test_neither_traffic_nor_roster_of_a_side_changes_what_the_other_side_receives(model: str, seed: int) -> None:
    air = replace(EXACT, delay=0.01, jitter=0.05, loss=0.2, model=model)
    alone = cyan_hears(air, ("magenta1",), 0, seed)
    assert cyan_hears(air, ("magenta1",), 1, seed) == alone
    assert cyan_hears(air, tuple(f"magenta{number}" for number in range(1, 9)), 8, seed) == alone
    assert cyan_hears(air, ("zeta", "anna"), 1, seed) == alone
    assert cyan_hears(air, ("magenta1",), 0, seed + 100) != alone


def test_names_are_all_that_a_links_draws_depend_on() -> None:
    """A robot that joins a team leaves the links of the others as they are."""
    air = replace(EXACT, jitter=0.05, loss=0.3)
    three, four = radio(air), radio(air, of=roster(("cyan1", "cyan9", "cyan2", "cyan3")))
    for tick in range(1, 100):
        for one in (three, four):
            one.send(tick, {"cyan1": Radio(intention=str(tick))})
        assert list(three.receive(tick))[1] == list(four.receive(tick))[2]


def test_whole_ticks_are_counted_from_the_end_of_the_tick_in_recordings_of_before() -> None:
    """Delays of 1 to 2 ticks all end at 2: the rule by which recordings without the number were made."""
    assert RadioChannel(delay=0.02, jitter=0.02, loss=0.01, budget=2.2e6).model == "ticks"
    ages = first_ages(replace(EXACT, delay=0.02, jitter=0.02, model="ticks"))
    assert set(ages["cyan2"]) == {0.04}
