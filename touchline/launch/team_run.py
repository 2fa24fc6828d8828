"""The robots of one team on this machine, whose host runs elsewhere: one supervised process each."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from coach_gateway.match.follower import MatchFollower
from robot_agent.process.claim import Membership
from robot_agent.process.runner import ask_setup
from robot_agent.process.settings import AgentSettings
from runtime.bus.contract import Bus
from runtime.process.clock import Clock
from schemas.config.confinement import Isolation
from schemas.config.match_config import MatchConfig
from schemas.errors import MatchFailedError, TouchlineError, did_you_mean
from schemas.side import Side
from touchline.launch.confinement.robot_confinement import team_confinements, team_isolation_note
from touchline.launch.confinement.team_code import team_program
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.fork_server import ROBOTS
from touchline.launch.processes.log_notes import LogWatch
from touchline.launch.processes.process_table import Process
from touchline.launch.processes.robot_process import robot_process
from touchline.launch.processes.stop_signals import StopSignals
from touchline.launch.processes.supervisor import AT_ONCE, Supervisor
from touchline.launch.terminal.screen import Screen
from touchline.launch.terminal.status_line import status_line
from touchline.timing import POLL_S


@dataclass(frozen=True, slots=True)
class TeamPlan:
    """What is launched for a team."""

    side: Side
    robots: Sequence[str]
    """Robots to launch; empty for all of the side."""
    agent: AgentSettings
    """Settings of each robot, but for its name."""
    config: MatchConfig
    """The match as this machine launches it, without its name and the robots: the team, its limits, its isolation."""
    folder: Path
    """Holds settings, logs and working folders of the robots."""


class TeamRun:
    """A team from its launch to the end of its match."""

    def __init__(self, plan: TeamPlan, bus: Bus, screen: Screen, clock: Clock) -> None:
        """`bus` is the match's.

        Raises:
            TouchlineError: the host refuses the team, or a robot is none of the side.
        """
        self._plan, self._bus, self._screen, self._clock = plan, bus, screen, clock
        setup = ask_setup(bus, plan.agent.patience)
        self._total = sum(len(team.robots) for team in setup.teams.values())
        self._robots = _chosen(plan, setup.teams[plan.side].robots)
        self._config = _config_of(plan, setup.match, self._robots)
        beside = plan.agent.brain_folder
        self._confinement = team_confinements(self._config, beside, plan.folder.parent)[plan.side]
        self._note = team_isolation_note(self._config, plan.side, beside)
        member = Membership(bus, self._robots[0], plan.agent.launch_token, plan.agent.match, plan.side)
        if not member.fits(setup):
            member.join(setup, plan.agent.patience)  # the host refuses it, and reports that on its side, too
        self._log_watch = LogWatch(screen)
        launch = partial(ChildProcess, folder=plan.folder)
        self._supervisor = Supervisor([self._process(robot) for robot in self._robots], launch, clock)

    def play(self) -> None:
        """Run the robots until the match is over, or until SIGINT or SIGTERM.

        Raises:
            MatchFailedError: no robot is left although the match goes on.
        """
        follower = MatchFollower(self._bus)
        with StopSignals() as stop:
            try:
                if self._plan.config.isolate is Isolation.NONE:
                    ROBOTS.prepare()
                if self._note:
                    self._screen.warn(self._note)
                self._supervisor.start()
                self._screen.event(f"{', '.join(self._robots)} started; logs are in {self._plan.folder}", notable=True)
                while stop.received is None and not self._has_ended(follower):
                    self._show(follower)
                    self._clock.sleep_until(self._clock.now() + POLL_S)
            finally:
                self._supervisor.end(AT_ONCE)
                self._log_watch.count()
        self._report_end(follower, interrupted=stop.received is not None)

    def _has_ended(self, follower: MatchFollower) -> bool:
        """Whether the match is over, or no robot is left."""
        follower.update()
        is_over = follower.finished and follower.gone
        return is_over or all(robot in self._supervisor.ended for robot in self._robots)

    def _show(self, follower: MatchFollower) -> None:
        for log in self._supervisor.logs:
            self._log_watch.update(log)
        for notice in self._supervisor.check():
            if self._supervisor.ended.get(notice.name) == 0 and follower.gone:
                continue  # it has left with its host
            self._log_watch.show(notice)
        if follower.gone:
            self._screen.status("the host is gone")
        else:
            self._screen.status(status_line(follower, self._total))

    def _report_end(self, follower: MatchFollower, *, interrupted: bool) -> None:
        if interrupted:
            self._screen.event(f"{self._plan.side} has left", notable=True)
        elif follower.gone:
            self._screen.event("the host is gone", notable=True)
        else:
            reason = self._supervisor.reason(self._robots[0])
            raise MatchFailedError(f"no robot of {self._plan.side} is left; {reason}; logs are in {self._plan.folder}")

    def _process(self, robot: str) -> Process:
        agent = self._plan.agent.model_copy(update={"robot": robot, "match": self._bus.match, "side": self._plan.side})
        confinement = self._confinement.in_folder(self._plan.folder / robot)
        program = (
            team_program(self._config, self._plan.side, None) if self._config.team(self._plan.side).command else ()
        )
        return robot_process(agent.robot, agent, self._plan.side, program, self._plan.folder, confinement)


def _config_of(plan: TeamPlan, match: str, robots: Sequence[str]) -> MatchConfig:
    """The match as this machine launches it."""
    own = plan.config.team(plan.side).model_copy(update={"robots": list(robots)})
    teams = plan.config.teams.model_copy(update={plan.side.value: own})
    return plan.config.model_copy(update={"name": match, "teams": teams})


def _chosen(plan: TeamPlan, robots: list[str]) -> list[str]:
    """The robots to launch.

    Raises:
        TouchlineError: one of them is none of the side, or the side has none.
    """
    if not robots:
        raise TouchlineError(f"no robots of {plan.side} take part in this match; ask for another match file")
    for robot in plan.robots:
        if robot not in robots:
            raise TouchlineError(
                f"--robot {robot}: no robot of {plan.side} has that name; {did_you_mean(robot, robots)}"
            )
    return list(plan.robots) or robots
