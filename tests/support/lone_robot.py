"""A match in which cyan2 alone meets a ball at rest."""

from robot_agent.sdk.contract import Briefing
from schemas.config.match_config import MatchConfig
from touchline.play.play_match import InProcessMatch


def one_robot_and_a_ball(robot_x: float, ball_x: float) -> MatchConfig:
    """Both on the long axis of the field, the robot faces along +x."""
    scene = {
        "description": "A robot meets a ball at rest.",
        "game": {"phase": "play"},
        "ball": {"x": ball_x, "y": 0.0},
        "robots": [{"name": "cyan2", "side": "cyan", "x": robot_x, "y": 0.0, "heading": 0.0}],
    }
    team = {"brain": "robot_agent.teams.simple:Simple"}
    return MatchConfig.model_validate(
        {"seed": 1, "rules": "msl", "scene": scene, "teams": {"cyan": team, "magenta": team}}
    )


def briefing_of(config: MatchConfig) -> Briefing:
    """What cyan2 is told."""
    match = InProcessMatch(config, {})
    briefing = Briefing.of("cyan2", match.simulation.setup())
    match.close()
    return briefing
