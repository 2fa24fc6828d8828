"""One picture of a match, as large as the terminal: pitch, robots, events."""

from collections.abc import Mapping

from rich.text import Text

from coach_gateway.match.follower import MatchFollower
from schemas.messages.debug import RobotDebug
from schemas.messages.setup import Setup
from touchline.watch import panel
from touchline.watch.drawings import values
from touchline.watch.pitch import field, rows_for

LEAST_PITCH = 40
"""Cells; below this width of the pitch the robots are listed below it, not beside it."""
LEAST_EVENTS = 3
"""Rows reserved for events."""


def draw_match(
    follower: MatchFollower,
    setup: Setup,
    width: int,
    height: int,
    drawings: Mapping[str, RobotDebug] | None = None,
    robot: str | None = None,
) -> list[Text]:
    """The picture, at most `height` rows of at most `width` cells.

    `drawings` maps robots to what they draw now; the values of `robot` are listed.
    """
    drawings = drawings or {}
    is_beside = width >= LEAST_PITCH + 2 + panel.WIDTH
    pitch_width = width - panel.WIDTH - 2 if is_beside else width
    room = max(1, height - 2 - LEAST_EVENTS)
    robots = panel.robots(setup, follower.world, follower.radios, follower.state, follower.health)
    orders = panel.orders(follower.orders)
    shown = values(robot, drawings) if robot is not None else []
    shapes = [drawing.debug for drawing in drawings.values()]
    pitch_height = min(room, rows_for(setup.pitch, pitch_width))
    rows = field(setup, follower.world, follower.state, pitch_width, pitch_height, shapes)
    if is_beside:
        below = [*orders, *shown]
        rows = _beside(rows, pitch_width, [*_fitting(robots, room - len(below)), *below])[:room]
    elif len(rows) + len(robots) + len(orders) + len(shown) <= room:
        rows = [*rows, *robots, *orders, *shown]
    happened = panel.events(setup, follower, height - 2 - len(rows))
    rows = [panel.head(setup, follower.state), *rows, *happened, panel.foot(follower)][:height]
    for row in rows:
        row.truncate(width, overflow="ellipsis")
    return rows


def _fitting(robots: list[Text], room: int) -> list[Text]:
    """The rows of the robots; where there is no room for all, the last row has the number of those left out."""
    if len(robots) <= room:
        return robots
    shown = max(0, room - 1)
    return [*robots[:shown], Text(f"{len(robots) - shown} more robots: make the terminal higher", style=panel.QUIET)]


def _beside(left: list[Text], width: int, right: list[Text]) -> list[Text]:
    """Two columns, the first of them `width` cells wide."""
    rows = []
    for place in range(max(len(left), len(right))):
        row = left[place].copy() if place < len(left) else Text()
        row.pad_right(width + 2 - row.cell_len)
        rows.append(row + right[place] if place < len(right) else row)
    return rows
