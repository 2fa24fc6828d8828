"""The page on recordings: its Python examples run on a recording of a match."""

from collections.abc import Callable
from pathlib import Path

import pytest

from recordings.container.attachments import make_attachments
from recordings.container.manifest import EndReason, Result, make_manifest
from recordings.recorder.recording_writer import RecordingWriter
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.config.match_config import load_match
from schemas.topics import WORLD
from schemas.wire.message import VERSION
from sim_host.match.simulation import Simulation, TickResult
from support.stepped_clock import SteppedClock
from touchline.play.play_match import play_match


def test_the_lines_that_read_a_file_with_the_stock_package_alone(
    root: Path,
    fenced: Callable[[str, str], list[str]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from schemas.wire.part import encode

    config, clock = load_match(None, {"duration": 5.0}), SteppedClock()
    simulation = Simulation(config)
    writer = RecordingWriter(tmp_path / "match.mcap", clock)
    head = make_manifest(config.name, "test", clock, simulation.setup(), config, sights=False)
    simulation.close()
    files = make_attachments(config)
    writer.begin(head, files)
    said: list[TickResult] = []
    play_match(config, watch=said.append, until=0.2)
    for number, tick in enumerate(said):
        stamp = Stamp(number, 1, round(tick.time * 1e9))
        payload = encode({"version": VERSION, **tick.world})
        writer.write([(stamp.sim_ns, ReceivedMessage(WORLD, WORLD.key, payload, stamp))])
    writer.finish(Result(ended=EndReason.STOPPED, finished=""))
    page = (root / "docs" / "recordings.md").read_text("utf-8")
    code = next(piece for piece in fenced(page, "python") if "make_reader" in piece)
    assert "recordings" not in code and "schemas" not in code
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "docs/recordings.md", "exec"), {})
    first, *rows = capsys.readouterr().out.splitlines()
    assert first == "friendly lockstep"
    assert [float(row.split()[0]) for row in rows] == pytest.approx([tick.time for tick in said])
    named = page.split("| attachments |")[1].splitlines()[0]
    assert [name for name in files if f"`{name}`" not in named] == []
