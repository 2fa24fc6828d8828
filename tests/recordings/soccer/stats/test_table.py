"""The figures in words for a terminal."""

from recordings.soccer.stats.table import ROBOT_HEADINGS, UNKNOWN, headline, remarks, robot_rows, side_rows
from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase


def test_the_tables_tell_what_was_counted(script) -> None:
    script.held_by = "cyan2"
    script.shot(touches=["cyan2"])
    script.held_by = None
    script.shot(touches=["cyan2"], kicked="cyan2", speed=(8.0, 0.0, 0.0))
    script.rest(1)
    script.goal(Side.CYAN, "cyan2")
    card = {"kind": EventKind.CARD, "side": Side.MAGENTA, "robot": "magenta2", "card": Card.RED}
    script.shot(events=[{"kind": EventKind.FOUL, "side": Side.MAGENTA, "robot": "magenta2"}, card])
    script.shot(phase=Phase.KICK_OFF, side=Side.MAGENTA)
    figures = script.figures()
    assert headline(figures).startswith("Team cyan 1 : 0 Team magenta   0.6 s recorded, ball in play 0.4 s")
    rows = {name: values for name, *values in side_rows(figures)}
    assert rows["possession"] == ["100 %", "0 %"]
    assert rows["shots on goal"] == ["1 of 1", "0 of 0"]
    assert rows["foul: rule"] == rows["red cards"] == ["0", "1"]
    assert "yellow cards" not in rows
    assert rows["restart: kick off"] == ["0", "1"]
    table = robot_rows(figures)
    assert [row[0] for row in table] == ["cyan1 GK", "cyan2", "magenta1 GK", "magenta2"]
    assert {len(row) for row in table} == {len(ROBOT_HEADINGS)}
    assert remarks(figures) == []


def test_what_a_recording_does_not_tell_is_unknown_and_not_zero(script) -> None:
    script.messages = [(time, message) for time, message in script.messages if not hasattr(message, "phase")]
    figures = script.figures()
    rows = {name: values for name, *values in side_rows(figures)}
    for name in ("goals", "possession", "passes completed", "shots on goal", "saves", "dribbles"):
        assert rows[name] == [UNKNOWN, UNKNOWN]
    assert rows["distance, m"] == ["0.0", "0.0"]
    said = " ".join(remarks(figures))
    for word in ("states", "touches", "holds", "events"):
        assert word in said
