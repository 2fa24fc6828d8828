"""The radio's shared channel: one message at a time, in the order of sending, whichever side sends."""

import random
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

from schemas.config.sections import RadioChannel
from schemas.messages.radio import Radio
from schemas.side import Side
from schemas.wire.part import encode
from sim_host.match.radio import RadioAir
from sim_host.match.radio_medium import SharedChannel
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import Roster

TICK = 0.02
SHARED = RadioChannel(
    delay=0.0, jitter=0.0, loss=0.0, budget=1e9, model="shared", bit_rate=1e6, frame_time=0.0, queue=5.0
)
CYAN, MAGENTA = ([f"{side}{number}" for number in range(1, 6)] for side in ("cyan", "magenta"))


def radio(air: RadioChannel = SHARED, seed: int = 1) -> RadioAir:
    roster = Roster((*CYAN, *MAGENTA), (Side.CYAN,) * 5 + (Side.MAGENTA,) * 5, {}, ())
    return RadioAir(air, roster, TICK, RandomStreams(seed))


def waits_of(load: float, messages: int = 40_000) -> list[float]:
    """How long messages of 1 ms wait that arrive as a Poisson process with this load of the channel."""
    channel, dice, at, waits = SharedChannel(), random.Random(3), 0.0, []
    for _ in range(messages):
        at += dice.expovariate(load / 1e-3)
        end, refusal = channel.transmit(at, 1000, SHARED)
        assert refusal is None
        waits.append(end - 1e-3 - at)
    return waits


@pytest.mark.parametrize("load", [0.2, 0.5, 0.8])
def test_the_mean_wait_is_that_of_the_queue_m_d_1(load: float) -> None:
    """Pollaczek and Khinchine: ρ·s/(2·(1 − ρ)), and a share 1 − ρ finds the channel free."""
    waits = waits_of(load)
    assert np.mean(waits) == approx(load * 1e-3 / (2 * (1 - load)), rel=0.05)
    assert np.mean(np.array(waits) < 1e-12) == approx(1 - load, abs=0.01)


def test_a_message_takes_its_bits_and_the_time_of_a_frame() -> None:
    end, _ = SharedChannel().transmit(7.0, 3000, replace(SHARED, frame_time=4e-4))
    assert end == approx(7.0 + 0.003 + 0.0004)


def test_messages_wait_in_the_order_of_sending() -> None:
    channel = SharedChannel()
    ends = [channel.transmit(at, 1000, SHARED)[0] for at in (0.0, 0.0002, 0.0004, 0.01)]
    assert ends == approx([0.001, 0.002, 0.003, 0.011])


def test_a_message_that_finds_a_longer_queue_is_refused_and_takes_no_time() -> None:
    air, channel = replace(SHARED, queue=0.002), SharedChannel()
    refusals = [channel.transmit(0.0, 1000, air)[1] for _ in range(5)]
    assert refusals[:3] == [None] * 3 and all("busy for 0.003 s" in str(one) for one in refusals[3:])
    assert channel.transmit(0.001, 1000, air)[1] is None, "one message later there is room"


def heard_ages(senders: Sequence[str], word: Radio, air: RadioChannel = SHARED, ticks: int = 600) -> list[float]:
    """Age of each of cyan1's messages in the first sight of cyan2 that has it, while all of these send in each tick."""
    one, ages, last = radio(air), [], -1
    for tick in range(1, ticks + 1):
        one.send(tick, {name: replace_number(word, tick) for name in senders})
        heard = list(one.receive(tick))[1].get("cyan1")
        if heard is not None and heard.extra["n"] != last:
            last = int(heard.extra["n"])
            ages.append(heard.age)
    return ages


def replace_number(word: Radio, tick: int) -> Radio:
    return Radio(intention=word.intention, extra={"n": tick + 1000})  # always four digits: equal lengths


def test_each_side_slows_the_other() -> None:
    """Ten messages of 1.6 ms a tick load the channel by 0.8: cyan's own five wait for magenta's."""
    word = Radio(intention="x" * 64)
    bits = 8 * len(encode(replace_number(word, 1)))
    air = replace(SHARED, bit_rate=bits / 1.6e-3)
    alone, together = (heard_ages(names, word, air) for names in (CYAN, CYAN + MAGENTA))
    assert np.mean(alone) < np.mean(together) - 5e-4
    separate = [heard_ages(names, word, replace(air, model="separate")) for names in (CYAN, CYAN + MAGENTA)]
    assert separate[0] == separate[1], "with a channel of its own, it does not"


def test_a_side_that_fills_the_channel_has_messages_of_both_sides_refused() -> None:
    word = Radio(intention="x" * 64)
    bits = 8 * len(encode(word))
    one, refused = radio(replace(SHARED, bit_rate=bits / 5e-3, queue=0.05)), set()
    for tick in range(1, 100):
        refusals = one.send(tick, dict.fromkeys(["cyan1", *MAGENTA], word))
        assert all("busy" in reason for reason in refusals.values())
        refused |= set(refusals)
    assert "cyan1" in refused and len(refused) == 6


def test_the_last_to_send_in_a_tick_finds_the_budget_spent_and_not_the_last_in_the_roster() -> None:
    word = Radio(intention="x" * 64)
    air = replace(SHARED, bit_rate=1e8, budget=2.5 * 8 * len(encode(word)))
    refused = set()
    for seed in range(20):
        one = radio(air, seed)
        (name,) = one.send(1, dict.fromkeys(CYAN[:3], word))
        refused.add(name)
        left = {sender: heard.age for sender, heard in list(one.receive(2))[CYAN.index("cyan4")].items()}
        assert name not in left and len(left) == 2
    assert refused == set(CYAN[:3])


def test_a_message_on_the_channel_arrives_although_the_roster_changes() -> None:
    word = Radio(intention="x" * 64)
    one = radio(replace(SHARED, bit_rate=8 * len(encode(word)) / 0.1))
    one.send(1, {"cyan1": word})
    one.receive(1)
    heir = one.with_roster(Roster(("cyan2", "cyan1"), (Side.CYAN,) * 2, {}, ()))
    arrivals = [tick for tick in range(2, 10) if next(heir.receive(tick))]
    assert arrivals[0] == 6, "it left within tick 1 and was on the air for five ticks"
