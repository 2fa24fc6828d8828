"""One picture of a match, as large as the terminal: pitch, robots, events."""

from rich.text import Text

from arena.watch import panel
from arena.watch.pitch import field, rows_for
from coach_gateway.closeup import Closeup
from schemas.host import Setup

LEAST_PITCH = 40
"""Cells; a narrower pitch has the robots below it, not beside it."""
LEAST_EVENTS = 3
"""Rows that are kept for what happened."""


def picture(seen: Closeup, setup: Setup, width: int, height: int) -> list[Text]:
    """At most `height` rows of at most `width` cells."""
    view = seen.match
    is_beside = width >= LEAST_PITCH + 2 + panel.WIDTH
    pitch_width = width - panel.WIDTH - 2 if is_beside else width
    room = max(1, height - 2 - LEAST_EVENTS)
    robots = panel.robots(setup, seen.world, seen.words, view.state, view.health)
    robots += panel.orders(seen.orders.book)
    rows = field(setup, seen.world, view.state, pitch_width, min(room, rows_for(setup.pitch, pitch_width)))
    if is_beside:
        rows = _beside(rows, pitch_width, robots)[:room]
    elif len(rows) + len(robots) <= room:
        rows = [*rows, *robots]
    happened = panel.events(view, height - 2 - len(rows))
    whole = [panel.head(setup, view.state), *rows, *happened, panel.foot(view)][:height]
    for row in whole:
        row.truncate(width, overflow="ellipsis")
    return whole


def _beside(left: list[Text], width: int, right: list[Text]) -> list[Text]:
    """Two columns, the first of them `width` cells wide."""
    rows = []
    for place in range(max(len(left), len(right))):
        row = left[place].copy() if place < len(left) else Text()
        row.pad_right(width + 2 - row.cell_len)
        rows.append(row + right[place] if place < len(right) else row)
    return rows
