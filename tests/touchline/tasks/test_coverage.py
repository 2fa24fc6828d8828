"""The score of coverage: cells that robots have been in, of those that they can reach."""

from pytest import approx

from support.task_moment import scored
from touchline.tasks.coverage import CELL


def test_a_cell_counts_once_and_a_place_beyond_the_lines_never() -> None:
    first = scored("coverage", {"rover1": (-4.8, -3.3), "rover2": (-4.7, -3.2)})
    again = scored("coverage", {"rover1": (-4.8, -3.3), "rover2": (0.0, 3.7)}, memory=first.memory)
    other = scored("coverage", {"rover1": (-4.8, -3.3), "rover2": (4.9, 3.4)}, memory=again.memory)
    assert 0.0 < first.value == again.value == approx(other.value / 2)


def test_cells_in_an_obstacle_are_not_asked_for() -> None:
    seen = scored("coverage", {"rover1": (2.6, -1.2), "rover2": (-0.5, 1.5)})
    assert seen.value == 0.0
    cells = 20 * 14
    free = seen.memory[1].bit_count()
    assert 0.8 * cells < free < 0.95 * cells


def test_the_task_ends_when_all_is_covered() -> None:
    memory, score = None, None
    for row in range(14):
        for column in range(20):
            place = (column + 0.5) * CELL - 5.0, (row + 0.5) * CELL - 3.5
            score = scored("coverage", {"rover1": place, "rover2": place}, memory)
            assert score.over == (score.value == 1.0)
            memory = score.memory
    assert score is not None and score.over
