"""The ledger as a table: one row for each robot, and lines on the host, radio and strangers."""

from collections.abc import Callable, Iterator

from rich.console import Group, RenderableType
from rich.style import Style
from rich.table import Table
from rich.text import Text

from touchline.commands.diagnosis.health.ledger import Ledger, RobotLedger
from touchline.launch.terminal.console import table

_TROUBLE = Style(color="yellow", bold=True)
_UNKNOWN = "–"

_COLUMNS: tuple[tuple[str, Callable[[RobotLedger], str]], ...] = (
    ("sights", lambda row: str(row.sights)),
    ("on time", lambda row: str(row.on_time)),
    ("late", lambda row: str(row.late)),
    ("missing", lambda row: str(row.missing)),
    ("double", lambda row: str(row.double)),
    ("invalid", lambda row: str(row.invalid)),
    ("sights lost", lambda row: str(row.lost_sights)),
    ("commands lost", lambda row: str(row.lost_commands)),
    ("p50 ms", lambda row: _ms(row.p50_ms)),
    ("p99 ms", lambda row: _ms(row.p99_ms)),
    ("radio kB", lambda row: f"{row.radio_bytes / 1e3:.1f}"),
    ("of budget", lambda row: _UNKNOWN if row.radio_share is None else f"{100 * row.radio_share:.2g} %"),
    ("refused", lambda row: str(row.radio_refused)),
)
"""Heading and value of each column after the robot and its state."""
HEADINGS = ("robot", "agent", *(heading for heading, _ in _COLUMNS))


def ledger_view(ledger: Ledger) -> RenderableType:
    """The whole ledger for the console."""
    parts: list[RenderableType] = [Text(_headline(ledger), style="bold"), _robot_table(ledger)]
    if ledger.accounts:
        parts += [Text(), _account_table(ledger)]
    if ledger.hardware:
        parts += [Text(), _hardware_table(ledger)]
    return Group(*parts, *map(Text, _remarks(ledger)))


def _headline(ledger: Ledger) -> str:
    return (
        f"{ledger.start:.1f} s to {ledger.end:.1f} s, {ledger.ticks} ticks  {ledger.pace}  "
        f"×{ledger.real_time_factor:.2f}  late ticks {ledger.late_ticks}  worst tick {ledger.worst_tick_ms:.1f} ms"
    )


def _robot_table(ledger: Ledger) -> Table:
    shown = table(HEADINGS, names=2)
    for row in ledger.robots:
        in_trouble = row.state in ("absent", "silent")
        shown.add_row(
            row.robot, row.state, *(value(row) for _, value in _COLUMNS), style=_TROUBLE if in_trouble else None
        )
    return shown


def _account_table(ledger: Ledger) -> Table:
    shown = table(("account", "messages", "kB", "dropped"))
    shown.columns[-1].justify = "left"
    for row in ledger.accounts:
        dropped = "; ".join(f"{count} {reason}" for reason, count in row.dropped.items()) or "0"
        style = _TROUBLE if row.dropped else None
        shown.add_row(row.account, str(row.messages), f"{row.size / 1e3:.1f}", dropped, style=style)
    return shown


def _hardware_table(ledger: Ledger) -> Table:
    """A row for each device and each call of a robot's hardware."""
    shown = table(("robot", "hardware", "device or call", "count", "refused or late", "Hz", "ms", "worst ms"), names=3)
    for name, robot in ledger.hardware.items():
        state, style = f"{robot.state}, {'armed' if robot.armed else 'not armed'}", _TROUBLE if robot.reason else None
        for device, read in robot.devices.items():
            age = _ms(1e3 * read.age if read.age is not None else None)
            row = str(read.readings), str(read.refused), f"{read.rate:.0f}", age, _UNKNOWN
            shown.add_row(name, state, device, *row, style=style)
        for method, call in robot.calls.items():
            row = str(call.calls), str(call.late), _UNKNOWN, _ms(call.mean_ms), _ms(call.worst_ms)
            shown.add_row(name, state, f"{method}()", *row, style=style)
    return shown


def _remarks(ledger: Ledger) -> Iterator[str]:
    for name, robot in ledger.hardware.items():
        counts = f"{robot.clamped} demands shortened, {robot.filtered} filtered, fell back {robot.fell_back} times"
        yield f"{name}: {counts}" + (f"; {robot.fallback}: {robot.reason}" if robot.reason else "")
    for row in ledger.robots:
        if row.fault:
            yield f"{row.robot}: {row.fault}"
    for side, share in ledger.radio_busiest.items():
        yield f"radio {side}: busiest second {100 * share:.2g} % of the budget"
    for key, count in ledger.strangers.items():
        yield f"{count} messages on {key}, which is no robot's of this match"
    for name, behind in ledger.recorders.items():
        yield f"recorder {name}: {behind} ticks behind"


def _ms(ms: float | None) -> str:
    return _UNKNOWN if ms is None else f"{ms:.1f}"
