"""The values that one robot's program shows its author."""

from collections.abc import Mapping

from rich.style import Style
from rich.text import Text

from coach_gateway.match.team_names import printable
from schemas.messages.debug import RobotDebug

_HEAD = Style(bold=True)


def values(robot: str, drawings: Mapping[str, RobotDebug]) -> list[Text]:
    """The values of one robot by name, with a heading; one row that says so where it shows none."""
    shown = drawings[robot].debug.values if robot in drawings else {}
    if not shown:
        return [Text(f"{robot} shows no values")]
    longest = max(map(len, shown))
    rows = [Text(f" {printable(name):{longest}}  {_figure(value)}") for name, value in shown.items()]
    return [Text(f"{robot} shows", style=_HEAD), *rows]


def _figure(value: float | bool | str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.6g}" if isinstance(value, float | int) else printable(value)
