import itertools
import random

import pytest

from robot_agent.teams.simple.assignment import cheapest_assignment


def total(costs, columns):
    return sum(row[column] for row, column in zip(costs, columns, strict=True))


@pytest.mark.parametrize("rows, columns", [(0, 0), (1, 1), (1, 4), (3, 3), (3, 4), (4, 6), (6, 6), (2, 10)])
def test_no_other_assignment_costs_less(rows, columns):
    draw = random.Random(rows * 10 + columns)
    for _ in range(40):
        costs = [[round(draw.uniform(-1.0, 9.0), 1) for _ in range(columns)] for _ in range(rows)]
        found = cheapest_assignment(costs)
        assert len(set(found)) == rows
        least = min(total(costs, order) for order in itertools.permutations(range(columns), rows))
        assert total(costs, found) == pytest.approx(least)
