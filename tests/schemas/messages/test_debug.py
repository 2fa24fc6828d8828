"""The drawing that a command may carry: its frames, and its bounds."""

import math
from typing import Any

import numpy as np
import pytest

from schemas.messages.command import Command
from schemas.messages.debug import (
    COLOURS,
    MAX_BYTES,
    MAX_CORNERS,
    MAX_SHAPES,
    MAX_VALUES,
    Debug,
    DebugCorner,
    DebugPoint,
    DebugPolygon,
    DebugText,
)
from schemas.wire.faults import FaultError
from schemas.wire.message import BadMessageError
from touchline import Drawing


def drawn() -> Drawing:
    """One shape of each kind."""
    drawing = Drawing()
    drawing.value("gap", 0.5)
    drawing.point((1.0, 2.0))
    drawing.line((0.0, 0.0), (3.0, -4.0), "red")
    drawing.circle((5.0, 1.0), 0.5, "#0a0b0c")
    drawing.polygon([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)])
    drawing.text((2.0, 2.0), "here")
    return drawing


def test_a_drawing_survives_the_wire() -> None:
    command = Command(answers_tick=3, debug=drawn().debug())
    assert Command.decode(command.encode()) == command


def test_the_side_that_attacks_ahead_draws_in_the_field_frame() -> None:
    debug = drawn().debug()
    assert debug.in_field_frame(1) is debug


def test_the_other_side_is_turned_about_the_centre_mark() -> None:
    turned = drawn().debug().in_field_frame(-1)
    assert (turned.points[0].x, turned.points[0].y) == (-1.0, -2.0)
    assert (turned.lines[0].x1, turned.lines[0].x2, turned.lines[0].y2) == (0.0, -3.0, 4.0)
    assert (turned.circles[0].x, turned.circles[0].y, turned.circles[0].radius) == (-5.0, -1.0, 0.5)
    assert [(one.x, one.y) for one in turned.polygons[0].corners] == [(0.0, 0.0), (-1.0, 0.0), (-1.0, -1.0)]
    assert (turned.texts[0].x, turned.texts[0].text) == (-2.0, "here")
    assert turned.values == {"gap": 0.5}
    assert math.copysign(1.0, turned.lines[0].x1) == 1.0, "0, never -0"


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"points": [DebugPoint(x=0, y=0)] * (MAX_SHAPES + 1)}, "a list of at most 64 entries"),
        ({"values": {str(number): 1 for number in range(MAX_VALUES + 1)}}, "an object of at most 64 entries"),
        ({"values": {"": 1}}, "values."),
        ({"values": {"gap": math.nan}}, "debug.values.gap is nan; a finite number"),
        (
            {"texts": [DebugText(x=0, y=0, text="x" * 80)] * 64, "points": [DebugPoint(x=0, y=0)] * 64},
            f"at most {MAX_BYTES}",
        ),
    ],
)
def test_more_than_the_bounds_is_refused_in_one_line_where_it_is_made(fields: dict[str, Any], reason: str) -> None:
    with pytest.raises(FaultError, match=reason) as error:
        Debug(**fields)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("colour", ["purple", "#12345", "#12345g", "red\n", ""])
def test_another_colour_is_refused_with_the_colours_there_are(colour: str) -> None:
    with pytest.raises(FaultError, match=r"colour is .*; #rrggbb, or one of white, "):
        DebugPoint(x=0, y=0, colour=colour)


@pytest.mark.parametrize("colour", [*COLOURS, "#0aF9c3"])
def test_a_colour_is_a_name_or_a_code(colour: str) -> None:
    assert DebugPoint(x=0, y=0, colour=colour).colour == colour


def test_coordinates_are_finite_metres() -> None:
    with pytest.raises(FaultError, match=r"debug_point\.x is nan; m from -100 to 100"):
        DebugPoint(x=math.nan, y=0)
    with pytest.raises(FaultError, match=r"debug_corner\.y is 500"):
        Drawing().polygon([(0, 0), (1, 500)])


def test_a_polygon_has_a_bounded_number_of_corners() -> None:
    with pytest.raises(FaultError, match=f"at most {MAX_CORNERS} entries"):
        DebugPolygon(corners=[DebugCorner(x=0, y=0)] * (MAX_CORNERS + 1))


def test_a_value_that_json_has_no_number_for_becomes_text() -> None:
    drawing = Drawing()
    drawing.value("time", math.inf)
    drawing.value("angle", math.nan)
    drawing.value("speed", np.float64(1.5))
    assert drawing.debug().values == {"time": "inf", "angle": "nan", "speed": 1.5}


def test_the_largest_drawing_fits_into_a_command() -> None:
    texts = [DebugText(x=0.123456789012345, y=-0.5, text="x" * 80)] * 64
    while True:
        try:
            largest = Debug(texts=texts)
        except FaultError:
            texts = texts[1:]
        else:
            break
    assert len(Command(answers_tick=1, debug=largest).encode()) > MAX_BYTES - 200
    assert Command.decode(Command(answers_tick=1, debug=largest).encode()).debug == largest


def test_a_command_beyond_its_bytes_is_refused() -> None:
    with pytest.raises(BadMessageError, match="12288"):
        Command.decode(Command(answers_tick=1).encode() + b" " * 12288)
