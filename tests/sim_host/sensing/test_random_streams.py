"""Randomness: known answers, independence, and no memory."""

import numpy as np
import pytest
from pytest import approx

from sim_host.sensing.random_streams import BATCH, SMALL_BATCH, BatchedDraws, RandomStreams, StreamId, philox

NAMES = ("cyan1", "cyan2", "magenta1")


@pytest.mark.parametrize(
    ("counter", "key", "answer"),
    [
        ((0, 0, 0, 0), (0, 0), (0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8)),
        ((0xFFFFFFFF,) * 4, (0xFFFFFFFF,) * 2, (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD)),
        (
            (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
            (0xA4093822, 0x299F31D0),
            (0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
        ),
    ],
)
def test_philox_gives_the_known_answers(
    counter: tuple[int, ...], key: tuple[int, int], answer: tuple[int, ...]
) -> None:
    """The published known-answer vectors of Philox4x32-10."""
    words = philox(tuple(np.array([word], dtype=np.uint64) for word in counter), key)  # type: ignore[arg-type]
    assert tuple(int(word[0]) for word in words) == answer


def test_a_draw_depends_on_its_own_coordinates_and_on_nothing_else() -> None:
    streams = RandomStreams(7)
    many = streams.normals(StreamId.OWN, NAMES, range(100), 6)
    alone = streams.normals(StreamId.OWN, NAMES[1:2], range(42, 43), 6)
    assert (many[42, 1] == alone[0, 0]).all()
    fewer = streams.normals(StreamId.OWN, NAMES, range(100), 3)
    assert (many[:, :, :3] == fewer).all()


def test_a_draw_between_two_robots_depends_on_their_names_and_not_on_other_robots() -> None:
    streams = RandomStreams(7)
    many = streams.pairwise_uniforms(StreamId.SEEN, NAMES, ("ball", *NAMES), range(20))
    alone = streams.pairwise_uniforms(StreamId.SEEN, NAMES[2:], ("cyan2",), [13])
    assert many.shape == (20, 3, 4, 4)
    assert (alone[0, 0, 0] == many[13, 2, 2]).all()
    assert np.unique(many).size == many.size, "each way has draws of its own"


@pytest.mark.parametrize("other", [RandomStreams(8), RandomStreams(7 + 2**32)])
def test_another_seed_gives_other_draws(other: RandomStreams) -> None:
    mine = RandomStreams(7).uniforms(StreamId.OWN, NAMES, range(10), 4)
    assert not np.isclose(mine, other.uniforms(StreamId.OWN, NAMES, range(10), 4)).any()


def test_streams_of_different_robots_kinds_and_ticks_are_independent() -> None:
    """Correlations of 10,000 draws stay within 4 standard errors, 0.04."""
    streams = RandomStreams(3)
    own = streams.normals(StreamId.OWN, NAMES, range(10_000), 2)
    ball = streams.normals(StreamId.BALL, NAMES, range(10_000), 2)
    series = [own[:, 0, 0], own[:, 1, 0], own[:, 0, 1], ball[:, 0, 0]]
    for i, one in enumerate(series):
        for other in series[i + 1 :]:
            assert np.corrcoef(one, other)[0, 1] == approx(0, abs=0.04)
        assert np.corrcoef(one[1:], one[:-1])[0, 1] == approx(0, abs=0.04)


def test_normal_draws_are_normal() -> None:
    draws = RandomStreams(1).normals(StreamId.OWN, NAMES, range(5000), 4).ravel()
    assert draws.mean() == approx(0, abs=4 / np.sqrt(draws.size))
    assert draws.std() == approx(1, rel=0.01)
    assert (np.abs(draws) < 1.959964).mean() == approx(0.95, abs=0.004)
    assert (draws**4).mean() == approx(3, rel=0.05)


def test_errors_are_normal_within_their_cut_and_a_share_is_lost_whatever_the_others_are() -> None:
    streams = RandomStreams(1)
    many = streams.errors(StreamId.SENSOR, NAMES, range(3000), 6, 0.2)
    alone = streams.errors(StreamId.SENSOR, NAMES[1:2], range(42, 43), 3, 0.2)
    assert np.array_equal(many[42, 1, :3], alone[0, 0], equal_nan=True)
    errors = many[~np.isnan(many)]
    assert errors.size / many.size == approx(0.8, abs=0.01)
    assert errors.mean() == approx(0, abs=4 / np.sqrt(errors.size)) and errors.std() == approx(1, rel=0.01)
    assert (np.abs(errors) < 1.959964).mean() == approx(0.95, abs=0.004)
    assert 3.5 < np.abs(errors).max() < 4.01
    for lost in (0.0, 1.0):
        assert (np.isnan(streams.errors(StreamId.SENSOR, NAMES, range(100), 6, lost)) == lost).all()


def test_uniform_draws_lie_strictly_between_nought_and_one() -> None:
    draws = RandomStreams(1).uniforms(StreamId.AIR, NAMES, range(5000), 4)
    assert 0 < draws.min() < 0.001 and 0.999 < draws.max() < 1
    assert draws.mean() == approx(0.5, abs=0.005)


@pytest.mark.parametrize("size", [BATCH, SMALL_BATCH, 1])
def test_blocks_give_the_same_numbers_in_any_order(size: int) -> None:
    streams = RandomStreams(5)
    block = BatchedDraws(lambda ticks: streams.normals(StreamId.OWN, NAMES, ticks, 4), size)
    for tick in (2 * size + 2, 3, size, size - 1, 2 * size + 3, 3):
        assert (block.at(tick) == streams.normals(StreamId.OWN, NAMES, range(tick, tick + 1), 4)[0]).all()
