"""The assignment problem: one column for each row, with the least sum of costs (the Hungarian method)."""

import math
from collections.abc import Sequence


def cheapest_assignment(costs: Sequence[Sequence[float]]) -> list[int]:
    """The column of each row; no two rows get the same one. There are at least as many columns as rows.

    Adds one row after the other. A new row takes a column from an earlier one along the path that costs least, with
    costs reduced by the prices of rows and columns.
    """
    columns = len(costs[0]) if costs else 0
    row_price, column_price = [0.0] * len(costs), [0.0] * (columns + 1)
    row_of: list[int | None] = [None] * (columns + 1)
    """Column → its row; the last column stands for the row that is added."""
    for row in range(len(costs)):
        row_of[columns] = row
        least, before = [math.inf] * columns, [columns] * columns
        reached, column = [False] * (columns + 1), columns
        while (current := row_of[column]) is not None:
            reached[column] = True
            price, here = row_price[current], costs[current]
            step, following = math.inf, column
            for other in range(columns):
                if reached[other]:
                    continue
                reduced = here[other] - price - column_price[other]
                if reduced < least[other]:
                    least[other], before[other] = reduced, column
                if least[other] < step:
                    step, following = least[other], other
            for other in range(columns + 1):
                owner = row_of[other]
                if reached[other] and owner is not None:
                    row_price[owner] += step
                    column_price[other] -= step
                elif other < columns:
                    least[other] -= step
            column = following
        while column != columns:
            row_of[column] = row_of[before[column]]
            column = before[column]
    column_of = {row: column for column, row in enumerate(row_of[:columns]) if row is not None}
    return [column_of[row] for row in range(len(costs))]
