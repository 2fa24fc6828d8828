"""What brains draw, in the terminal."""

import io

import pytest
from rich.console import Console
from rich.text import Text
from typer.testing import CliRunner

from schemas.bus.in_process_bus import SharedState
from schemas.errors import TouchlineError
from schemas.messages.debug import Debug, DebugCircle, DebugLine, DebugPoint, DebugText, RobotDebug
from schemas.process.clock import SteppedClock
from schemas.topics import DEBUG, WORLD
from support.messages import make_setup, make_world
from touchline.command_line import app
from touchline.commands.watch import watch_on
from touchline.watch.drawings import values
from touchline.watch.pitch import field, rows_for

SETUP = make_setup()
WIDTH = 90
HEIGHT = rows_for(SETUP.pitch, WIDTH)


def colours(debug: Debug) -> dict[tuple[int, int], str]:
    """Row and column of each cell with a colour of a drawing."""
    rows = field(SETUP, None, None, WIDTH, HEIGHT, [debug])
    found: dict[tuple[int, int], str] = {}
    for number, row in enumerate(rows):
        for span in row.spans:
            colour = span.style.color if not isinstance(span.style, str) else None
            if colour is not None and colour.name.startswith("#"):
                found |= {(number, column): colour.name for column in range(span.start, span.end)}
    return found


def test_a_point_is_marked_where_it_is_in_its_colour() -> None:
    cells = colours(Debug(points=[DebugPoint(x=5.0, y=3.0, colour="red")]))
    assert set(cells.values()) == {"#ff0000"}
    middle_row = sum(row for row, _ in cells) / len(cells)
    middle_column = sum(column for _, column in cells) / len(cells)
    assert middle_column == pytest.approx(WIDTH / 2 + 5.0 * WIDTH / 23.6, abs=1.5)
    assert middle_row == pytest.approx(HEIGHT / 2 - 3.0 * HEIGHT / 15.6, abs=1.5)


def test_a_line_spans_its_ends_and_a_circle_has_its_width() -> None:
    line = {column for _, column in colours(Debug(lines=[DebugLine(x1=-5, y1=2, x2=5, y2=2)]))}
    assert max(line) - min(line) == pytest.approx(10 * WIDTH / 23.6, abs=2)
    circle = {column for _, column in colours(Debug(circles=[DebugCircle(x=0, y=0, radius=2)]))}
    assert max(circle) - min(circle) == pytest.approx(4 * WIDTH / 23.6, abs=2)


def test_a_text_is_written_without_characters_that_a_terminal_obeys() -> None:
    rows = field(SETUP, None, None, WIDTH, HEIGHT, [Debug(texts=[DebugText(x=0, y=5, text="plan \x1b[2J b")])])
    text = "\n".join(row.plain for row in rows)
    assert "plan �[2J b" in text and "\x1b" not in text


def test_shapes_beyond_the_pitch_are_cut_off() -> None:
    colours(Debug(lines=[DebugLine(x1=-100, y1=-100, x2=100, y2=100)], points=[DebugPoint(x=100, y=100)]))


def plain(rows: list[Text]) -> list[str]:
    return [row.plain for row in rows]


def test_values_are_listed_by_name() -> None:
    debug = Debug(values={"gap": 0.123456789, "plan": "pass\n", "open": True, "count": 3})
    drawings = {"cyan2": RobotDebug(tick=1, time=0.02, robot="cyan2", debug=debug)}
    rows = ["cyan2 shows", " gap    0.123457", " plan   pass�", " open   true", " count  3"]
    assert plain(values("cyan2", drawings)) == rows
    assert plain(values("cyan1", drawings)) == ["cyan1 shows no values"]


class HostOfTicks(SteppedClock):
    """Goes on by a tick whenever the watcher waits; after three ticks the host leaves."""

    __slots__ = ("host", "tick")

    def sleep_until(self, moment: float) -> None:
        """Play the next tick."""
        super().sleep_until(moment)
        self.tick += 1
        if self.tick > 3:
            self.host.close()
        else:
            at = {"tick": self.tick, "time": self.tick * 0.02}
            debug = Debug(values={"gap": self.tick / 8}, points=[DebugPoint(x=3, y=1, colour="#010203")])
            drawn = RobotDebug(**at, robot="cyan2", debug=debug)
            self.host.publisher(DEBUG, side="cyan", robot="cyan2").put(drawn)
            self.host.publisher(WORLD).put(make_world(self.tick, (self.tick, 0.0)))


def watched(monkeypatch: pytest.MonkeyPatch, robot: str | None) -> str:
    """The last picture of a match of three ticks."""
    medium, clock = SharedState(), HostOfTicks()
    clock.host, clock.tick = medium.open_bus("friendly", SteppedClock()), 0
    clock.host.declare_alive("host", "host")
    monkeypatch.setattr("coach_gateway.match.host_client.HostClient.setup", lambda self: SETUP)
    console = Console(file=io.StringIO(), force_terminal=True, width=140, height=40, color_system="truecolor")
    watch_on(medium.open_bus("friendly", clock), console, robot)
    last: str = console.file.getvalue().split("\x1b[?1049l")[-1]  # type: ignore[attr-defined]
    return last


def test_a_watched_match_shows_shapes_and_the_values_of_one_robot(monkeypatch: pytest.MonkeyPatch) -> None:
    picture = watched(monkeypatch, "cyan2")
    assert "38;2;1;2;3m" in picture
    assert "cyan2 shows" in picture and "gap  0.375" in picture
    assert "gap" not in watched(monkeypatch, None)


def test_a_robot_that_does_not_take_part_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(TouchlineError, match="--robot cyan77: no such robot takes part"):
        watched(monkeypatch, "cyan77")


def test_values_are_not_listed_in_plain_lines() -> None:
    result = CliRunner().invoke(app, ["watch", "--robot", "cyan2"])
    assert result.exit_code == 2
    assert "--robot lists values on a terminal only" in " ".join(result.output.split())
