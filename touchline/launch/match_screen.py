"""What a match shows in the terminal while it runs: events, slow agents, remote teams, and the status line."""

from collections.abc import Sequence

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.lines import event_line
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from runtime.bus.announcement import Announcement
from runtime.bus.endpoint import DEFAULT_ENDPOINT, local_endpoint, parse_endpoint
from runtime.process.clock import Clock
from schemas.messages.health import Health
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from touchline.launch.join_command import join_lines
from touchline.launch.processes.programs import MatchPlan
from touchline.launch.remote_teams import RemoteTeams
from touchline.launch.result import NOTABLE
from touchline.launch.terminal.agent_faults import InvalidAgents, SlowAgents
from touchline.launch.terminal.screen import Screen
from touchline.launch.terminal.status_line import status_line


class MatchScreen:
    """Prints what a match publishes."""

    def __init__(self, plan: MatchPlan, screen: Screen, remote: RemoteTeams, clock: Clock) -> None:
        self._plan = plan
        self._screen = screen
        self._remote = remote
        self._clock = clock
        self._names = TeamNames.of_match(plan.config)
        self._robots = sum(len(plan.config.robots(side)) for side in Side)
        self._slow_agents = SlowAgents()
        self._invalid_agents = InvalidAgents()
        self._has_waited = False

    def begin(self, announcement: Announcement) -> None:
        """Print where the host listens, who plays, how a remote team joins, and what teams are not isolated from."""
        expected = local_endpoint(self._plan.listen or DEFAULT_ENDPOINT)
        is_unexpected = parse_endpoint(announcement.endpoint)[1:] != parse_endpoint(expected)[1:]
        self._screen.event(f'match "{announcement.match}" on {announcement.endpoint}', notable=is_unexpected)
        if self._names != SIDES_ALONE:
            self._screen.event(str(self._names), notable=True)
        plan = self._plan
        for line in join_lines(plan.config, plan.listen, announcement.endpoint, plan.credentials):
            self._screen.event(line, notable=True)
        if plan.isolation_note:
            self._screen.event(plan.isolation_note, notable=False)

    def update(self, follower: MatchFollower) -> None:
        """Print what has arrived since the last call."""
        self.report(follower, follower.update().messages)

    def report(self, follower: MatchFollower, news: Sequence[GameEvent | GameState | Health]) -> None:
        """Print these messages, and the status line."""
        for message in news:
            if isinstance(message, GameEvent):
                self._screen.event(event_line(message, self._names), notable=message.kind in NOTABLE)
            elif isinstance(message, Health):
                for sentence in (*self._slow_agents.update(message), *self._invalid_agents.update(message)):
                    self._screen.warn(sentence)
                for line in self._remote.update(message, self._clock.now()):
                    self._screen.event(line, notable=True)
        waiting = self._remote.waiting(follower.health) if follower.health is not None else ""
        if waiting and not self._has_waited:
            self._has_waited = True
            self._screen.renew()  # the last status was of the host; people wait for this one
        self._screen.status(waiting or status_line(follower, self._robots, self._names))
