from robot_agent.process.stdio.lines import Line, LineSplitter


def test_lines_come_whole_however_their_bytes_arrive() -> None:
    splitter = LineSplitter(100)
    assert splitter.feed(b"one\ntw") == [Line(b"one")]
    assert splitter.feed(b"") == []
    assert splitter.feed(b"o\n\nthree\n") == [Line(b"two"), Line(b""), Line(b"three")]


def test_a_line_above_the_limit_is_cut_once_and_the_next_is_whole() -> None:
    splitter = LineSplitter(4)
    assert splitter.feed(b"123456") == [Line(b"1234", is_cut=True)]
    assert splitter.feed(b"789" * 1000) == []
    assert splitter.feed(b"\nnext\n") == [Line(b"next")]


def test_a_long_line_in_one_piece_is_cut_too() -> None:
    assert LineSplitter(4).feed(b"123456\nnext\n") == [Line(b"1234", is_cut=True), Line(b"next")]


def test_an_endless_line_fills_no_memory() -> None:
    splitter = LineSplitter(4)
    for _ in range(1000):
        splitter.feed(b"x" * 1000)
    assert len(vars(splitter)["_begun"]) <= 4
