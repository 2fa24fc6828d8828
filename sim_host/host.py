"""The host of one match: the simulation on the bus, tick by tick, at its pace."""

from collections.abc import Callable

from schemas.bus.contract import Bus
from schemas.bus.minutes import MinuteKeeper
from schemas.game import EventKind, GameEvent
from schemas.match_config import MatchConfig
from schemas.profile import Profile
from sim_host.attendance import Attendance
from sim_host.complaints import Complaints
from sim_host.desk import Desk
from sim_host.hands import Hands
from sim_host.inbox import Inbox
from sim_host.outbox import Outbox
from sim_host.pace import Lockstep, Pace, Realtime
from sim_host.pulse import Pulse
from sim_host.simulation import Simulation, Tick
from sim_host.standing import StandingOrders

_LAST_WORDS_S = 0.75
"""Wall time that the host stays after full time for those who watch: what they missed of the end shows with the bus's
next heartbeat, half a second after it, and can be fetched again as long as the host is there."""
_PARTING_S = 5.0
"""Wall time that the host waits at the end for its recorders to take in the last tick."""


class Host:
    """A match that agents, coaches and recorders meet in."""

    def __init__(self, config: MatchConfig, bus: Bus) -> None:
        self.simulation = Simulation(config)
        self._complaints = Complaints()
        self._minutes = MinuteKeeper(bus)
        self.inbox = Inbox(bus, self.simulation.roster, self._complaints, self._minutes)
        self.attendance = Attendance(bus, self.inbox.ledgers, config.patience.recorder)
        self._hands = Hands(bus, self._complaints)
        self._config = config
        self._clock = bus.clock
        self._desk = Desk(bus, self.simulation, self._complaints, self._minutes, self.attendance.is_officiated)
        self.pace = _pace(config, bus, self.inbox, self.attendance, self._meanwhile, self.simulation.profile)
        tick_s = self.simulation.profile.time.tick
        self._outbox = Outbox(self._minutes, self.simulation.roster, tick_s, sights_kept=config.record.sights)
        self._standing = StandingOrders(self._minutes, self.simulation.orders, self.inbox.ledgers, tick_s)
        self._pulse = Pulse(bus.clock, config.pace)
        self._roster = self.simulation.roster
        self._silent = dict.fromkeys(self._roster.names, False)
        self.leaving = False
        """Somebody has told the host to end the match."""
        self._stamp(0)
        bus.declare_alive("host", "host")

    def run(self) -> None:
        """Play the match to its end, or until somebody tells the host to leave."""
        self.wait_for_all()
        self.begin()
        while not (self.simulation.over or self.leaving):
            self.tick()
        self.part()

    def leave(self) -> None:
        """End the match soon, but no tick in its middle: what was recorded of the last one is whole."""
        self.leaving = True
        self.pace.hurry()

    def wait_for_all(self) -> None:
        """Wait until every robot has an agent, as long as patience lasts; a referee action ends the waiting too."""
        deadline = self._clock.now() + self._config.patience.attendance
        while not self.attendance.all_here(self._config.record.wait) and self._clock.now() < deadline:
            if self.leaving:
                return
            self.attendance.update(timeout=0.02)
            self._attend()
            self._report(self.simulation.now)
            self._minutes.send_if_due()
            if self._desk.actions:
                return

    def begin(self) -> None:
        """Tell everyone of tick 0."""
        first = self.simulation.now
        for robot, sight in first.sights.items():
            self._send_sight(robot, sight)
        self._outbox.truth(first, self.simulation.state)
        self._minutes.end_tick(first.tick)
        self.pace.begin()

    def tick(self) -> Tick:
        """One tick: hear the robots, move the world, tell everyone."""
        commands = self.pace.gather(self.simulation.now.tick, self._outbox.sight_again)
        self.attendance.update()
        self._attend()
        self._stamp(self.simulation.now.tick + 1)
        commands = self._hands.lay_over(self.simulation.now.tick, self._roster.names, commands)
        silent = {name for name, is_silent in self._silent.items() if is_silent and name not in commands}
        tick = self.simulation.step(commands, self._desk.actions, self._send_sight, silent)
        self._outbox.truth(tick, self.simulation.state)
        self._standing.tell(tick.tick, tick.time, self.simulation.roster)
        self._desk.reply(tick.replies)
        self._keep_account(tick)
        self._report(tick)
        self._minutes.end_tick(tick.tick)
        return tick

    def part(self) -> None:
        """Give the recorders time to take in the last tick, and after full time those who watch to hear of it."""
        last = self.simulation.now.tick
        self._minutes.send()
        deadline = self._clock.now() + _PARTING_S
        while self._clock.now() < deadline:
            self.attendance.update(timeout=0.005)
            self._desk.attend()
            self._desk.refuse("the match is over")
            self._minutes.send_if_due()
            if not any(self.attendance.behind(last).values()):
                break
        if self.simulation.over and self.attendance.is_watched():
            self._stay(self._clock.now() + _LAST_WORDS_S)

    def _stay(self, until: float) -> None:
        """Answer that the match is over until this wall time, or until somebody tells the host to leave."""
        while self._clock.now() < until and not self.leaving:
            self._clock.sleep_until(min(until, self._clock.now() + 0.05))
            self._desk.attend()
            self._desk.refuse("the match is over")

    def _attend(self) -> None:
        """Answer who asks, and follow an operator who lets other robots take part."""
        self._desk.attend()
        roster = self.simulation.roster
        if (roster.names, roster.sides, roster.still) != (self._roster.names, self._roster.sides, self._roster.still):
            self.inbox.follow(roster)
            self.attendance.follow()
            self._outbox.follow(roster)
            self._silent = {name: self._silent.get(name, False) for name in roster.names}
        self._roster = roster

    def _meanwhile(self) -> None:
        """While answers are missing: whoever joins must know the match, and what was said must not wait as long."""
        self._desk.tell_setup()
        self._minutes.send_if_due()

    def _send_sight(self, robot: str, sight: bytes) -> None:
        """Sights go out before anything else: robots wait for them, watchers do not."""
        if robot == self.simulation.roster.names[0]:
            self.inbox.sights_sent(self.simulation.world.tick, self._clock.unix_ns())
        self._outbox.sight(robot, sight)

    def _stamp(self, tick: int) -> None:
        """What is sent from now on belongs to this tick."""
        self._clock.sim_ns = round(tick * self.simulation.profile.time.tick * 1e9)

    def _keep_account(self, tick: Tick) -> None:
        """Note what was refused, and say when a robot falls silent or is heard again."""
        for name, count in tick.refused.items():
            self.inbox.ledgers[name].refused += count
        for name, driven in self._hands.changes():
            text = f"{name} is driven by hand" if driven else f"{name} is given back to its brain"
            self._tell_of_agent(tick, name, "hand", text)
        for name, was_silent in self._silent.items():
            ledger = self.inbox.ledgers[name]
            if ledger.idle:
                continue
            fell = not ledger.alive or ledger.silent >= self.pace.silent_ticks
            silent = fell or (was_silent and not ledger.answering)
            if silent == was_silent:
                continue
            self._silent[name] = silent
            text = f"{name} does not answer, its robot rests" if silent else f"{name} answers"
            self._tell_of_agent(tick, name, "attendance", text)

    def _tell_of_agent(self, tick: Tick, name: str, rule: str, text: str) -> None:
        if name not in self._roster.names:
            return
        self._outbox.event(
            GameEvent(
                tick=tick.tick,
                time=tick.time,
                clock=self.simulation.state.clock,
                kind=EventKind.AGENT,
                rule=rule,
                side=self._roster.side_of(name),
                robot=name,
                text=text,
            )
        )

    def _report(self, tick: Tick) -> None:
        """Say how the host is doing, when it is time to, and of one invalid payload at most: a flood is not echoed."""
        invalid = self._complaints.take(tick.tick, tick.time)
        if invalid is not None:
            self._outbox.invalid(invalid)
        if self._pulse.beat(tick.time):
            late = self.pace.late_ticks
            self._outbox.health(self._pulse.report(tick.tick, tick.time, late, self.inbox, self.attendance))


def _pace(
    config: MatchConfig,
    bus: Bus,
    inbox: Inbox,
    attendance: Attendance,
    meanwhile: Callable[[], None],
    profile: Profile,
) -> Pace:
    if config.speed is None:
        return Lockstep(bus.clock, inbox, attendance, config.patience, meanwhile)
    return Realtime(bus.clock, inbox, profile.time.tick, config.speed, profile.safety.watchdog)
