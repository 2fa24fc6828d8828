"""The robots of one team, whose host runs elsewhere."""

from pathlib import Path

import pytest

from robot_agent.process.settings import AgentSettings
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side
from support.fake_host import MATCH, FakeHost
from support.in_process_bus import SharedState
from touchline.launch.team_run import TeamPlan, TeamRun


@pytest.mark.parametrize(
    ("wanted", "there", "sentence"),
    [
        ([], [], "no robots of cyan take part in this match; ask for another match file"),
        (["cyan3"], ["cyan1", "cyan2"], "--robot cyan3: no robot of cyan has that name"),
    ],
)
def test_robots_that_take_no_part_in_the_match_are_not_launched(
    tmp_path: Path, wanted: list[str], there: list[str], sentence: str
) -> None:
    medium = SharedState()
    host = FakeHost(medium, in_threads=True)
    own = host.setup.teams[Side.CYAN].replace(robots=there)
    host.setup = host.setup.replace(teams=host.setup.teams | {Side.CYAN: own})
    settings = AgentSettings(connect="tcp/127.0.0.1:1", match=MATCH, robot="cyan1", brain="no:Brain")
    plan = TeamPlan(Side.CYAN, wanted, settings, MatchConfig(), tmp_path)
    with pytest.raises(TouchlineError, match=sentence):
        TeamRun(plan, medium.open_bus(MATCH, WallClock()), None, WallClock())
    host.close()
