from touchline.watch.braille import BrailleCanvas


def test_a_cell_has_two_dots_across_and_four_down() -> None:
    dots = BrailleCanvas(1, 1)
    for x in range(2):
        for y in range(4):
            dots.dot(x, y)
    assert dots.rows() == ["⣿"]


def test_each_dot_has_its_own_place() -> None:
    seen = set()
    for x in range(4):
        for y in range(8):
            dots = BrailleCanvas(2, 2)
            dots.dot(x, y)
            seen.add(tuple(dots.rows()))
    assert len(seen) == 32


def test_a_cell_without_dots_is_a_space_and_a_dot_beyond_the_canvas_is_nothing() -> None:
    dots = BrailleCanvas(3, 2)
    for x, y in ((-1, 0), (6, 0), (0, -1), (0, 8)):
        dots.dot(x, y)
    assert dots.rows() == ["   ", "   "]


def test_a_line_joins_its_ends_and_a_circle_keeps_its_distance() -> None:
    dots = BrailleCanvas(4, 1)
    dots.line(0, 0, 7, 0)
    assert dots.rows() == ["⠉⠉⠉⠉"]
    round_ = BrailleCanvas(10, 5)
    round_.circle(10, 10, 8)
    rows = round_.rows()
    assert rows[0].strip() and rows[4].strip() and not rows[2][4:6].strip()


def test_cells_that_a_pen_draws_in_have_its_colour() -> None:
    canvas = BrailleCanvas(4, 2)
    canvas.dot(0, 0)
    canvas.pen = "#ff0000"
    canvas.dot(6, 5)
    assert canvas.colours == {(1, 3): "#ff0000"}
