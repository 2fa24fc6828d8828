"""The panel of a match: score, phase, the host's health, robots, orders, latest events."""

import math
from collections.abc import Iterator, Mapping

from rich.style import Style
from rich.text import Text

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.lines import clock_text, event_line, half_text, phase_text, waiting_phrases
from coach_gateway.match.orders import OrderBook
from coach_gateway.match.team_names import TeamNames, printable
from schemas.config.task import score_text
from schemas.messages.coach import CoachOrder
from schemas.messages.debug import RobotDebug
from schemas.messages.health import Health
from schemas.messages.radio import Radio
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.messages.world import RobotTruth, World
from schemas.side import Side
from schemas.soccer.game import EventKind
from touchline.launch.terminal.debug_values import values
from touchline.launch.terminal.status_line import losses_text, robots_text

ARROWS = "→↗↑↖←↙↓↘"
"""Arrows of the headings, counter-clockwise from +x."""
SIDES = {
    Side.CYAN: Style(color="color(16)", bgcolor="color(51)"),
    Side.MAGENTA: Style(color="color(231)", bgcolor="color(163)", bold=True),
}
"""Side → style of its robots: dark on light and light on dark, to be distinct without colour vision."""
QUIET = Style(dim=True)
TROUBLE = Style(color="yellow", bold=True)
LOUD = {
    EventKind.GOAL: Style(bold=True),
    EventKind.CARD: TROUBLE,
    EventKind.FOUL: Style(color="yellow"),
    EventKind.ADVANTAGE: Style(color="yellow"),
}
"""Highlighted events."""
LEAST_EVENTS = 3
"""Rows reserved for events."""
_ACTIVITY = 26
"""Width of the robot's role and intention in its row, cells."""


def panel(
    follower: MatchFollower,
    setup: Setup,
    height: int,
    drawings: Mapping[str, RobotDebug] | None = None,
    robot: str | None = None,
) -> list[Text]:
    """The panel, at most `height` rows.

    `drawings` maps robots to what they draw now; the values of `robot` are listed.
    """
    shown = [*orders(follower.orders), *(values(robot, drawings or {}) if robot is not None else [])]
    listed = robots(setup, follower.world, follower.radios, follower.state, follower.health)
    rows = [head(setup, follower.state), health_line(follower)]
    rows += [*_fitting(listed, height - len(rows) - len(shown) - LEAST_EVENTS), *shown]
    return [*rows, *events(setup, follower, height - len(rows))][:height]


def _fitting(rows: list[Text], room: int) -> list[Text]:
    """The rows of the robots; where there is no room for all, the last row has the number of those left out."""
    if len(rows) <= room:
        return rows
    shown = max(0, room - 1)
    return [*rows[:shown], Text(f"{len(rows) - shown} more robots: make the terminal higher", style=QUIET)]


def head(setup: Setup, state: GameState | None) -> Text:
    """Teams and score, clock, half and phase, the referee's proposal, robots that teams have to name."""
    names = TeamNames.of_setup(setup)
    if state is None:
        return Text(f"{' – '.join(names[side] for side in names.playing)}  waiting for the robots")
    phase = (phase_text(state, names), Style(bold=True))
    if not names.has_goals:
        score = (f" {names.score(state.score, state.value)} ", Style(bold=True))
        return Text.assemble(score, f"  {clock_text(state.clock)}  ", phase)
    line = Text.assemble(
        (f" {names[Side.CYAN]} ", SIDES[Side.CYAN]),
        (f" {state.score.cyan} : {state.score.magenta} ", Style(bold=True)),
        (f" {names[Side.MAGENTA]} ", SIDES[Side.MAGENTA]),
        f"  score {score_text(state.value, names.unit)}" if state.value is not None else "",
        f"  {clock_text(state.clock)}  {half_text(state)}  ",
        phase,
    )
    for phrase in waiting_phrases(state, names):
        line.append(f"  {phrase}", TROUBLE)
    return line


def robots(
    setup: Setup, world: World | None, radios: Mapping[str, Radio], state: GameState | None, health: Health | None
) -> list[Text]:
    """One row for each robot: number and heading, role and intention, position, speed, ball, and trouble."""
    rows, everybody = [], numbered(setup)
    digits = max(len(str(number)) for _, _, number in everybody)
    for side, name, number in everybody:
        robot = world.robots.get(name) if world is not None else None
        row = Text.assemble((f"{number:>{digits}}{arrow(robot) if robot is not None else ' '}", SIDES[side]), " ")
        radio = radios.get(name)
        activity = Text(_activity(radio))
        activity.truncate(_ACTIVITY, overflow="ellipsis", pad=True)
        row.append(activity).append(" ")
        if robot is not None:
            speed = math.hypot(robot.vx, robot.vy)
            row.append(f"{robot.x:6.1f} {robot.y:5.1f} {speed:4.1f} m/s ")
            row.append("● " if robot.holding else "  ", Style(color="bright_yellow"))
        discipline = state.robots.get(name) if state is not None else None
        row.append(", ".join(_troubles(name, robot, discipline, health, setup.time.tick)), TROUBLE)
        rows.append(row)
    return rows


def numbered(setup: Setup) -> list[tuple[Side, str, int]]:
    """Side, name and number of all robots; the number is from the name, as on the page."""
    sides = setup.sides
    return [(sides[name], name, number) for name, number in numbers_of(sides).items()]


def arrow(robot: RobotTruth) -> str:
    """An arrow for a robot's heading, one of eight directions."""
    return ARROWS[round(robot.heading / (math.pi / 4.0)) % len(ARROWS)]


def _activity(radio: Radio | None) -> str:
    """Role and intention, as `striker: get the ball`; empty until the robot has published them."""
    return printable(": ".join(part for part in (radio.role, radio.intention) if part)) if radio is not None else ""


def _troubles(
    name: str, robot: RobotTruth | None, discipline: DisciplinaryRecord | None, health: Health | None, tick: float
) -> Iterator[str]:
    """The reasons that keep a robot from playing, and its cards."""
    if discipline is not None:
        left = "" if discipline.left is None else f" {discipline.left:.0f} s"
        if discipline.off_field is not None:
            yield f"{discipline.off_field.value.replace('_', ' ')}{left}"
        yield from (
            f"{count} {card}" for card, count in (("yellow", discipline.yellow), ("red", discipline.red)) if count
        )
    if robot is not None and robot.stuck:
        yield "stuck"
    agent = health.robots.get(name) if health is not None else None
    if agent is None or agent.still or health is None:
        return
    if not (agent.answering if health.tick > 0 else agent.alive):
        yield "silent" if health.tick > 0 else "missing"
    elif agent.latency_ms is not None and agent.latency_ms * 1e-3 >= tick:
        yield f"answers after {agent.latency_ms:.0f} ms"


def orders(book: OrderBook) -> list[Text]:
    """One row for each standing order: its content, and the robots that have not acknowledged it or refuse it."""
    rows = []
    for side in Side:
        if (active := book.active(side)) is None:
            continue
        receipt = book.receipt(side, active.order.sequence)
        missing = receipt.missing
        row = Text.assemble((f" {side.value} ", SIDES[side]), f" {_order_text(active.order)}")
        if missing:
            row.append(f"  not acknowledged by {', '.join(missing)}", TROUBLE)
        for why in dict.fromkeys(receipt.refused.values()):
            names = [name for name, its in receipt.refused.items() if its == why]
            row.append(f"  refused by {', '.join(names)}: {why}", TROUBLE)
        rows.append(row)
    return rows


def _order_text(order: CoachOrder) -> str:
    """An order as text: `hold`, `test pass, cyan2, cyan3`, `play: press`."""
    words = [f"test {order.test.value}" if order.test is not None else order.mode.value]
    words += [name for name in (order.robot_a, order.robot_b) if name is not None]
    return ", ".join(words) + (f": {order.tactic}" if order.tactic else "")


def events(setup: Setup, follower: MatchFollower, count: int) -> list[Text]:
    """The latest events, the newest last."""
    last = follower.events[-count:] if count > 0 else []
    names = TeamNames.of_setup(setup)
    return [Text(event_line(event, names), style=LOUD.get(event.kind, QUIET)) for event in last]


def health_line(follower: MatchFollower) -> Text:
    """Speed, late ticks, number of robots that answer, messages that recorders miss."""
    if (health := follower.health) is None:
        return Text("no health report from the host yet", style=QUIET)
    behind = f"  recorder {max(health.recorders.values())} ticks behind" if health.recorders else "  no recorder"
    total = sum(not robot.still for robot in health.robots.values())
    pace = f"{health.pace}, paused" if health.paused else health.pace
    words = f"×{health.real_time_factor:.2f} {pace}  late {health.late_ticks}  {robots_text(health, total)}"
    line = Text(f"{words}{behind}", style=QUIET)
    if losses := losses_text(follower):
        line.append(f"  {losses}", TROUBLE)
    return line
