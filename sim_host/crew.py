"""Those who serve the robots of a match: referee, watchdog, radio and sensors, for the robots and numbers in force."""

from collections.abc import Sequence
from dataclasses import replace

from schemas.match_config import MatchConfig
from schemas.roster import RosterEntry
from schemas.rule_book import RuleBook
from sim_host.actuation.commands import Commands
from sim_host.radio import RadioAir
from sim_host.referee.core import Referee
from sim_host.sensing.perception import Perception
from sim_host.sensing.streams import Streams
from sim_host.sights import Sights
from sim_host.snapshot import Roster
from sim_host.start import start_poses
from sim_host.tuning import Tuning


class Crew:
    """They follow an operator who changes numbers or robots; what they know of those who stay, they keep."""

    def __init__(self, config: MatchConfig, book: RuleBook, tuning: Tuning, robots: Sequence[RosterEntry]) -> None:
        self._config = config
        self._book = book
        self._streams = Streams(config.seed)
        self._tuning = tuning
        self._robots = robots
        self.roster = Roster.cast(robots, tuning.types)
        """Who takes part from the next tick on."""
        self.referee = self._new_referee()
        self.commands = Commands(self.roster.names, self._watchdog, self.roster.still)
        self.radio, self._perception = self._new_radio(), self._new_perception()
        self.sights = Sights(self.roster, self._perception, self.radio)

    def take(self, tuning: Tuning) -> bool:
        """Work with these numbers from now on; whether the world has to be remade for them."""
        before, self._tuning = self._tuning, tuning
        old, new = before.profile, tuning.profile
        if new.radio != old.radio:
            self.radio.change(new.radio)
        if tuning.sensing != before.sensing:
            self._perception.change(tuning.sensing)
        is_of_world = replace(new, radio=old.radio, safety=old.safety, sensing=old.sensing) != old
        if is_of_world:
            self.roster = Roster.cast(self._robots, tuning.types)
        self.commands = self.commands.handed_on(self.roster.names, self._watchdog, self.roster.still)
        return is_of_world

    def serve(self, robots: Sequence[RosterEntry], *, anew: bool) -> None:
        """Serve these robots from now on; `anew` if nothing that was told, said or seen before counts any more."""
        before, self._robots = self._robots, robots
        self.roster = Roster.cast(robots, self._tuning.types)
        self.referee = self._new_referee()
        if anew:
            self.commands = Commands((), self._watchdog)
            self.radio, self._perception = self._new_radio(), self._new_perception()
        elif robots != before:
            self.radio = self.radio.handed_on(self.roster)
            self._perception = self._perception.handed_on(self._tuning.sensing, self.roster)
        self.sights = Sights(self.roster, self._perception, self.radio)
        self.commands = self.commands.handed_on(self.roster.names, self._watchdog, self.roster.still)

    @property
    def _watchdog(self) -> float:
        """Ticks."""
        profile = self._tuning.profile
        return profile.safety.watchdog / profile.time.tick

    def _new_radio(self) -> RadioAir:
        """A radio on which nothing was said yet."""
        profile = self._tuning.profile
        return RadioAir(profile.radio, self.roster, profile.time.tick, self._streams)

    def _new_perception(self) -> Perception:
        """Sensors that have seen nothing yet."""
        return Perception(self._tuning.sensing, self.roster, self._streams, self._tuning.profile.time.tick)

    def _new_referee(self) -> Referee:
        """A referee has no memory of its own: what happened so far is in the state that it is given."""
        profile, config = self._tuning.profile, self._config
        return Referee(
            self._book,
            profile.field,
            profile.ball,
            self.roster,
            duration=config.duration,
            kick_off=config.referee.kick_off,
            automatic=config.referee.automatic,
            starts=start_poses(self.roster, profile.field, self._book.restarts),
            mode=config.referee.mode,
            proposal=config.referee.proposal,
            winner=config.referee.winner,
        )
