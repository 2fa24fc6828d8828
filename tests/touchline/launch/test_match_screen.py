"""What a match prints before it begins."""

import io
from types import SimpleNamespace
from typing import Any

import pytest

from runtime.bus.announcement import Announcement
from schemas.config.match_config import load_match
from schemas.messages.health import Health
from support.stepped_clock import SteppedClock
from touchline.launch.match_screen import MatchScreen
from touchline.launch.remote_teams import RemoteTeams
from touchline.launch.terminal.screen import Screen


class Kept(Screen):
    """Keeps what it is to print."""

    def __init__(self) -> None:
        super().__init__(io.StringIO(), SteppedClock())
        self.events: list[tuple[str, bool]] = []

    def event(self, line: str, *, notable: bool) -> None:
        self.events.append((line, notable))


@pytest.mark.parametrize(("port", "is_unusual"), [(7447, False), (7448, True)])
def test_the_teams_are_named_and_a_port_that_is_not_the_usual_one_is_highlighted(port: int, is_unusual: bool) -> None:
    config = load_match(None, {"teams.cyan.name": "Lions", "teams.magenta.name": "Tigers"})
    plan: Any = SimpleNamespace(config=config, listen=None, credentials=None, isolation_note="")
    screen = Kept()
    endpoint = f"tcp/127.0.0.1:{port}"
    MatchScreen(plan, screen, RemoteTeams(config), SteppedClock()).begin(Announcement.of("cup", endpoint))
    assert screen.events == [(f'match "cup" on {endpoint}', is_unusual), ("Lions (cyan) – Tigers (magenta)", True)]


def test_a_match_says_at_once_that_it_waits_for_a_remote_team() -> None:
    config, out, clock = load_match(None, {"teams.magenta.remote": True}), io.StringIO(), SteppedClock()
    plan, follower = SimpleNamespace(config=config), SimpleNamespace(state=None, health=None)
    screen: Any = MatchScreen(plan, Screen(out, clock), RemoteTeams(config), clock)  # type: ignore[arg-type]
    screen.report(follower, [])
    follower.health = Health(tick=0, time=0.0, pace="realtime", real_time_factor=0.0)
    screen.report(follower, [])
    screen.report(follower, [])
    first, second = out.getvalue().splitlines()
    assert first == "waiting for the host"
    assert second.startswith("waiting for magenta: no robot there; missing: magenta1, ")
