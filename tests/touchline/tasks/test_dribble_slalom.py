"""The score of dribble_slalom: gates that the ball passes in order, each on its side and in its direction."""

from typing import Any

import pytest

from schemas.soccer.game import Phase
from support.task_moment import scored

GATES = [
    *((-5.0, 0.7), (-2.5, -0.7), (0.0, 0.7), (2.5, -0.7), (5.0, 0.7)),
    *((5.0, -0.7), (2.5, 0.7), (0.0, -0.7), (-2.5, 0.7), (-5.0, -0.7)),
]
"""m; a place in each gate of a round."""


def through(x: float, y: float, ahead: int, memory: Any) -> tuple[float, Any]:
    """The score after the ball has rolled past (x, y) along +x (`ahead` 1) or -x, and what is remembered."""
    before = scored("dribble_slalom", ball=(x - 0.1 * ahead, y), memory=memory)
    after = scored("dribble_slalom", ball=(x + 0.1 * ahead, y), memory=before.memory)
    assert not after.over
    return after.value, after.memory


def test_each_gate_of_a_round_counts_and_the_next_round_goes_on() -> None:
    memory, values = None, []
    for gate, (x, y) in enumerate(GATES + GATES[:2]):
        value, memory = through(x, y, 1 if gate % 10 < 5 else -1, memory)
        values.append(value)
    assert values == list(range(1, 13))


@pytest.mark.parametrize(
    ("x", "y", "ahead"),
    [(-5.0, -0.7, 1), (-5.0, 0.7, -1), (-5.0, 1.6, 1), (-2.5, -0.7, 1)],
    ids=["the other side", "backward", "beside the gate", "the gate after it"],
)
def test_another_way_does_not_count_and_the_gate_can_still_be_passed(x: float, y: float, ahead: int) -> None:
    value, memory = through(x, y, ahead, None)
    assert value == 0
    assert through(*GATES[0], 1, memory)[0] == 1


def test_a_stop_of_play_ends_it_with_the_gates_so_far() -> None:
    score = scored("dribble_slalom", memory=(3, 0.1), phase=Phase.STOPPED)
    assert (score.value, score.over) == (3, True)
