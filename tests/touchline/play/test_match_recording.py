"""Recordings of matches in one process."""

from pathlib import Path

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.messages.command import Command
from schemas.messages.debug import Debug
from schemas.messages.sight import Sight
from schemas.topics import DEBUG
from touchline import Briefing
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch


class Debugs:
    def __init__(self, briefing: Briefing) -> None:
        pass

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, debug=Debug(values={"sight": sight.tick}))


def test_what_a_brain_shows_its_authors_is_recorded(tmp_path: Path) -> None:
    match = InProcessMatch(load_match(None, {"teams.cyan.size": 1, "teams.magenta.size": 1}), {"cyan1": Debugs})
    recording = MatchRecording(tmp_path / "shown.mcap", match.simulation.config, match.simulation)
    for _ in range(10):
        recording.add(match.step(), match.commands)
    recording.close()
    match.close()
    key = DEBUG.fill(side="cyan", robot="cyan1")
    shown = [message for _, message in open_recording(tmp_path / "shown.mcap").decoded(key)]
    assert [(one.tick, one.debug.values) for one in shown] == [(tick, {"sight": tick}) for tick in range(10)]
