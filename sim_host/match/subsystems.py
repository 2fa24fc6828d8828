"""The subsystems of a match: judge, watchdog, radio and sensors, for the current roster and parameters."""

from collections.abc import Sequence
from dataclasses import replace

from schemas.config.profile import Profile
from schemas.config.roster import RosterEntry
from sim_host.actuation.latest_commands import CommandLimits, LatestCommands
from sim_host.game.contract import Game
from sim_host.game.judging import Judge
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.radio import RadioAir
from sim_host.match.radio_use import RadioUse
from sim_host.match.sights import Sights
from sim_host.sensing.perception import Perception
from sim_host.sensing.random_streams import RandomStreams
from sim_host.sensing.sensors.suite import SensorSuite
from sim_host.snapshot import Roster


class Subsystems:
    """Judge, latest commands, radio and sensors; a change of the roster keeps the memory of robots that remain."""

    def __init__(self, seed: int, game: Game, live_parameters: LiveParameters, robots: Sequence[RosterEntry]) -> None:
        self._game = game
        self._streams = RandomStreams(seed)
        self._live_parameters = live_parameters
        self._robots = robots
        self.roster = Roster.of_entries(robots, live_parameters.types)
        """The robots that take part from the next tick on."""
        self.judge = self._new_judge()
        self.commands = LatestCommands(self.roster.names, self._command_limits, self.roster.still)
        self.radio_use = RadioUse()
        self.radio, self._perception = self._new_radio(), self._new_perception()
        self.sights = self._new_sights()

    def set_live_parameters(self, live_parameters: LiveParameters) -> bool:
        """Use these parameters from now on; returns whether the world has to be rebuilt for them."""
        before, self._live_parameters = self._live_parameters, live_parameters
        old, new = before.profile, live_parameters.profile
        if new.radio != old.radio:
            self.radio.change(new.radio)
        if live_parameters.sensing != before.sensing:
            self._perception.change(live_parameters.sensing)
        same_senses = replace(new, radio=old.radio, safety=old.safety, sensing=old.sensing, camera=old.camera)
        concerns_world = _of_world(same_senses) != _of_world(old)
        if live_parameters.types != before.types:
            self.roster = Roster.of_entries(self._robots, live_parameters.types)
            self._perception = self._perception.with_roster(live_parameters.sensing, self.roster)
            self.sights = self._new_sights()
        self.commands = self.commands.with_roster(self.roster.names, self._command_limits, self.roster.still)
        return concerns_world

    def set_roster(self, robots: Sequence[RosterEntry], *, new_episode: bool) -> None:
        """Use this roster from now on; in a `new_episode`, no earlier command, radio message or percept counts."""
        before, self._robots = self._robots, robots
        self.roster = Roster.of_entries(robots, self._live_parameters.types)
        self.judge = self._new_judge()
        if new_episode:
            self.commands = LatestCommands((), self._command_limits)
            self.radio, self._perception = self._new_radio(), self._new_perception()
        elif robots != before:
            self.radio = self.radio.with_roster(self.roster)
            self._perception = self._perception.with_roster(self._live_parameters.sensing, self.roster)
        self.sights = self._new_sights()
        self.commands = self.commands.with_roster(self.roster.names, self._command_limits, self.roster.still)

    @property
    def _command_limits(self) -> CommandLimits:
        """For how long a command is in force."""
        profile = self._live_parameters.profile
        return CommandLimits.of(profile.safety, profile.time.tick)

    def _new_radio(self) -> RadioAir:
        """A radio without messages."""
        profile = self._live_parameters.profile
        return RadioAir(profile.radio, self.roster, profile.time.tick, self._streams, self.radio_use)

    def _new_perception(self) -> Perception:
        """Sensors without memory."""
        return Perception(
            self._live_parameters.sensing, self.roster, self._streams, self._live_parameters.profile.time.tick
        )

    def _new_judge(self) -> Judge:
        """A judge; it has no memory of its own, since the state of the game is passed to every step."""
        return self._game.judge(self._live_parameters.profile, self.roster)

    def _new_sights(self) -> Sights:
        """Sights of the current roster; sensors of the table have no reading yet."""
        sensors = SensorSuite(self._live_parameters.profile, self.roster, self._streams)
        return Sights(self.roster, self._perception, self.radio, sensors)


def _of_world(profile: Profile) -> Profile:
    """The profile with types of robots that have the standard camera."""
    types = {
        name: {section: numbers for section, numbers in changes.items() if section != "camera"}
        for name, changes in profile.types.items()
    }
    return replace(profile, types=types)
