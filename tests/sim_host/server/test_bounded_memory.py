"""A host that plays on keeps no more: what it keeps of past ticks is bounded.

In real time, `make soak` checks all processes of a match; this test plays as many ticks in a fraction of the time.
"""

import gc
import sys

import pytest

from runtime.bus import batch_publisher
from schemas.config.match_config import load_match
from support.host_rig import HostRig

WARM_UP = 2000
"""Ticks after which all caches are full: the longest keep 1500 messages."""
PLAYED = 1000
"""Ticks after them, 20 s of simulated time."""
ROUND = 50
"""Ticks between two rounds of reading, in which clients get what they have subscribed to."""


def kept_blocks(rig: HostRig, ticks: int) -> int:
    """Blocks of memory of small Python objects after this many more ticks, when all clients have read."""
    for _ in range(ticks // ROUND):
        rig.ticks(ROUND)
        rig.read_all()
    gc.collect()
    return sys.getallocatedblocks()


def test_a_host_keeps_less_than_one_more_object_for_each_tick_that_it_plays(monkeypatch: pytest.MonkeyPatch) -> None:
    """Events alone are kept in full, about one in 50 ticks, up to 1500 of them."""
    monkeypatch.setattr(batch_publisher, "KEPT_BATCHES", 20)
    rig = HostRig(load_match(None, {f"teams.{side}.size": 1 for side in ("cyan", "magenta")}))
    rig.join_all()
    rig.begin()
    before = kept_blocks(rig, WARM_UP)
    assert kept_blocks(rig, PLAYED) - before < PLAYED
