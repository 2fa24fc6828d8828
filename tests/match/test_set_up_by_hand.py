"""A match of real processes in a scene, set up by hand while it runs, and simulated again from its recording."""

import pytest

from recordings.reading.recording import open_recording
from schemas.game import EventKind
from schemas.topics import COMMAND

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

WORDS = ("--scene", "two_on_one", "--name", "by_hand", "--pace", "x4", "--seed", "7")
BY_HAND = (
    ("parameters", "set", "drive.max_speed=1.5", "radio.loss=0.5"),
    ("scene", "place", "ball", "-9", "6", "--vx", "1"),
    ("scene", "remove", "magenta2"),
    ("scene", "add", "magenta7", "magenta", "10", "-6", "--type", "slow"),
    ("scene", "reset"),
)
"""Bodies are placed in corners, which stay empty however long the commands take."""


@pytest.fixture(scope="module")
def recording(start, listen, folder, endpoint):
    """The recording of a match that was set up by hand, and ended."""
    match = start(
        *("touchline", "match", *WORDS, "--listen", endpoint, "--record", "m.mcap", "--json"),
        folder=folder,
        name="match",
    )
    heard = listen("by_hand", endpoint, match)
    heard.until_tick(20)
    for number, words in enumerate((*BY_HAND, ("referee", "end-game"))):
        heard.for_ticks(20)
        meeting = ("--connect", endpoint, "--match", "by_hand")
        program = start("touchline", *words, *meeting, folder=folder, name=f"word{number}")
        assert program.status() == 0, program.err
    assert match.status() == 0, match.err
    return open_recording(folder / "m.mcap", whole=True)


def test_manual_changes_are_published_and_recorded(recording):
    events = [event for _, event in recording.decoded("game/event")]
    said = [event.text for event in events if event.kind in (EventKind.SCENE, EventKind.PARAMETERS)]
    assert said[0] == "operator sets drive.max_speed = 1.5, radio.loss = 0.5"
    assert said[1:3] == ["operator places the ball at (-9.00, 6.00)", "operator removes magenta2"]
    assert said[-1] == "operator goes back to the start of two_on_one; episode 2 begins"
    assert len(said) == len(BY_HAND)
    lost = [key for key, counts in recording.result.keys.items() if counts.lost and COMMAND.match(key) is None]
    assert lost == []  # of two commands in one packet the host's router drops one
    health = [health for _, health in recording.decoded("host/health")][-1]
    assert health.robots["magenta7"].removed and not health.robots["magenta2"].removed


def test_the_match_is_simulated_again_from_what_was_recorded(recording, simulated_again):
    noted = list(recording.decoded("host/applied"))
    assert [applied.tick for _, applied in noted] == list(range(len(noted)))
    payloads = [recorded.payload for recorded, _ in noted]
    assert simulated_again(recording.manifest.config, payloads) == [applied.chain for _, applied in noted]
