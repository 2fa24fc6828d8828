"""Checks the teams of a study before any match is played."""

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side
from sim_host.match.simulation import Simulation
from touchline.launch.check_brains import check_teams
from touchline.matches.engine.planned_match import Way
from touchline.matches.study.study_plan import StudyPlan
from touchline.play.play_match import InProcessMatch


def check_study_teams(plan: StudyPlan) -> dict[str, str]:
    """Build the world and the teams of each cell's first match; returns the fingerprint of what computes the world.

    Raises:
        TouchlineError: a team cannot be loaded, or cannot be played in the way of the study; or a number is invalid.
    """
    engine: dict[str, str] = {}
    world: Simulation | InProcessMatch
    for match in plan.matches(plan.study.first_seeds[:1]):
        for side in Side:
            _check_kind(match.planned.config, side, plan.study.way)
        if plan.study.way is Way.PROCESSES:
            check_teams(match.planned.config, plan.brain_folder)
            world = Simulation(match.planned.config)
            engine = world.setup().engine
        else:
            world = InProcessMatch(match.planned.config, brain_folder=plan.brain_folder)
            engine = world.simulation.setup().engine
        world.close()
    return engine


def _check_kind(config: MatchConfig, side: Side, way: Way) -> None:
    team = config.team(side)
    if team.remote:
        raise TouchlineError(f"teams.{side} is remote; a study starts its teams itself: give brain, stdio or command")
    if team.command is not None and way is Way.IN_PROCESS:
        raise TouchlineError(
            f'teams.{side} has a command, a program on the network; write way = "processes" in the study file'
        )
