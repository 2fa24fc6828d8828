"""The host of one match: steps the simulation on the bus, tick by tick, at the pace of the match."""

from collections.abc import Callable, Sequence

from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, PresenceKind, ReceivedMessage
from runtime.process.timing import PARTING_S, POLL_S
from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName
from sim_host.match.simulation import Simulation, TickResult
from sim_host.server.admission.door import Admission, PresenceTracker
from sim_host.server.inbox import Inbox
from sim_host.server.manual_control import ManualControl
from sim_host.server.pace import Lockstep, Pace, Realtime
from sim_host.server.reports.active_order_publisher import ActiveOrderPublisher
from sim_host.server.reports.debug_publisher import DebugPublisher
from sim_host.server.reports.health_reporter import HealthReporter
from sim_host.server.reports.host_reports import HostReports
from sim_host.server.reports.outbox import Outbox
from sim_host.server.services import Services
from sim_host.server.services.referee_seat import RefereeSeat
from sim_host.timing import FULL_TIME_GRACE_S, HEALTH_S, PRESENCE_S


class Host:
    """Connects a simulation to agents, coaches, recorders and watchers."""

    def __init__(
        self,
        config: MatchConfig,
        bus: Bus,
        launch_token: str | None = None,
        *,
        recorders: Sequence[str] = (),
        has_accounts: bool = False,
    ) -> None:
        """Make the host of a match, without stepping it.

        Args:
            config: the match.
            bus: the host's bus.
            launch_token: only agents that know it may play for a side that is not remote; None admits every agent.
            recorders: further recorders than the match file's that a lockstep host waits for.
            has_accounts: credentials bind each key to an account.
        """
        self.simulation = Simulation(config)
        self._admission = Admission(config, self._sides(), launch_token, recorders, has_accounts=has_accounts)
        self.accounts = self._admission.accounts
        self._batches = BatchPublisher(bus, self._admission.invalid_log.add)
        self.inbox = Inbox(bus, self.simulation.roster, self._batches, self._admission)
        self.presence = self._admission.follow(bus, self.inbox.agent_stats)
        self._manual = ManualControl(bus, self._admission)
        self._first = self.simulation.now, self.simulation.state
        self._config = config
        self._clock = bus.clock
        self._seat = RefereeSeat()
        self._services = Services(
            bus, self.simulation, self._batches, self._seat, self._admission, self.presence.claim_handler.add_refusal
        )
        self.pace = _pace(config, bus, self.inbox, self.presence, self._while_waiting, self.simulation.profile)
        self._bus = bus
        self._accounts_updated_at = bus.clock.now()
        tick_s = self.simulation.profile.time.tick
        self._outbox = Outbox(self._batches, self.simulation.roster, tick_s)
        self._debug = DebugPublisher(self._batches, tick_s)
        self._reports = HostReports(
            self._outbox, self.simulation, self.presence, self._seat, self._admission, self._services.pause
        )
        self._active_orders = ActiveOrderPublisher(
            self._batches, self.simulation.orders, self.inbox.agent_stats, tick_s
        )
        self._health = HealthReporter(bus.clock, config.pace)
        self._roster = self.simulation.roster
        self._silent = dict.fromkeys(self._roster.names, False)
        self.stopping = False
        """The host was asked to end the match."""
        self._set_sim_time(0)
        bus.declare_alive(PresenceKind.HOST, "host")

    def run(self) -> None:
        """Play the match to its end, or until `stop` is called.

        Raises:
            TouchlineError: the score of a free game failed; all ticks before are recorded.
        """
        self.wait_for_all()
        self.begin()
        try:
            while not (self.simulation.over or self.stopping):
                self.tick()
        except TouchlineError:
            self.wait_for_recorders()
            raise
        self.wait_for_recorders()

    def stop(self) -> None:
        """End the match after the tick that is under way, so that the recording of its last tick is complete."""
        self.stopping = True
        self.pace.stop_waiting()

    def outcome(self) -> list[ReceivedMessage]:
        """All events so far, and the newest state of the game."""
        return self._outbox.outcome()

    def wait_for_all(self) -> None:
        """Wait until every robot has an agent, until patience runs out, or until a referee action is requested.

        A remote side of which no robot is there is waited for even then: whoever launched the host ends such a match.
        """
        deadline = self._clock.now() + self._config.longest_attendance
        while not self.presence.all_present(self._config.record.wait) and (
            self._clock.now() < deadline or self._lacks_remote_side()
        ):
            if self.stopping:
                return
            self.presence.update(timeout=POLL_S)
            self._serve_between_ticks()
            if self._services.requests.actions:
                return

    def _wait_while_paused(self) -> None:
        """Serve all clients until an operator lets the match run or step; no tick decides actions meanwhile."""
        if not self._services.pause.is_paused:
            return
        while self._services.pause.is_paused and not self.stopping:
            self._services.requests.refuse("the match is paused; ask the referee when it runs again")
            self._services.wait_for_operator(POLL_S)
            self.presence.update()
            self._serve_between_ticks()
        self.pace.begin()

    def _serve_between_ticks(self) -> None:
        """Process requests, and publish reports and batches that are due, while no tick is computed."""
        self._process_requests()
        self._reports.publish(self.simulation.now)
        self._report(self.simulation.now)
        self._batches.send_if_due()

    def _lacks_remote_side(self) -> bool:
        sides, stats = self._sides(), self.inbox.agent_stats
        there = {side for name, side in sides.items() if stats[name].alive}
        return any(side in self._config.remote_sides and side not in there for side in sides.values())

    def begin(self) -> None:
        """Publish tick 0."""
        self._look_for_sight_recorders()
        first, state = self._first
        for robot, sight in first.sights.items():
            self._send_sight(robot, sight)
        self._outbox.publish_tick(first, state)
        self._batches.end_tick(first.tick)
        self.pace.begin()

    def tick(self) -> TickResult:
        """One tick: collect commands, step the simulation once the match is not paused, publish the result."""
        commands = self.pace.gather(self.simulation.now.tick, self._outbox.resend_sight)
        self._debug.publish(commands, self._roster, self.simulation.state)
        self.presence.update()
        self._process_requests()
        self._wait_while_paused()
        self._look_for_sight_recorders()
        self._set_sim_time(self.simulation.now.tick + 1)
        commands = self._manual.override(self.simulation.now.tick, self._roster.names, commands)
        silent = {name for name, is_silent in self._silent.items() if is_silent and name not in commands}
        requested = self._services.requests.actions
        # the end of the game for a side whose robots go on above the limit of messages; of both sides, neither wins
        over = self.accounts.forfeiting()
        loser = over[0] if len(over) == 1 else None
        ends = [RefereeAction(action=ActionName.END_GAME, side=loser, source="host")] if over else []
        tick = self.simulation.step(
            commands, [*requested, *ends], self._send_sight, silent, self.presence.has_referee_box()
        )
        self._outbox.publish_tick(tick, self.simulation.state)
        self._active_orders.publish(tick.tick, tick.time, self.simulation.roster)
        self._services.requests.reply(tick.replies[: len(requested)])
        self._update_stats(tick)
        self._report(tick)
        self._batches.end_tick(tick.tick)
        return tick

    def wait_for_recorders(self) -> None:
        """Wait until the recorders have read the last tick, and after full time until watchers can have received it.

        For those that a lockstep host waits for in a match, it does so here, too: as long as they make progress.
        """
        last = self.simulation.now.tick
        self._publish_health(self.simulation.now)  # the counts of the whole match
        self._batches.send()
        deadline = self._clock.now() + PARTING_S
        awaited: dict[str, int] = {}
        while self._clock.now() < deadline:
            self.presence.update(timeout=PRESENCE_S)
            self._services.process()
            self._services.requests.refuse("the match is over")
            self._batches.send_if_due()
            if not any(self.presence.recorder_lags(last).values()):
                break
            before, awaited = awaited, self.presence.awaited_recorders()
            if awaited != before:
                deadline = max(deadline, self._clock.now() + self._config.patience.recorder)
        if self.simulation.over and self.presence.has_watchers():
            self._linger(self._clock.now() + FULL_TIME_GRACE_S)

    def _linger(self, until: float) -> None:
        """Refuse requests, since the match is over, until this wall time or until `stop` is called."""
        while self._clock.now() < until and not self.stopping:
            self._clock.sleep_until(min(until, self._clock.now() + POLL_S))
            self._services.process()
            self._services.requests.refuse("the match is over")

    def _process_requests(self) -> None:
        """Process requests, and apply a roster that an operator has changed."""
        self._seat.update_box(self.presence.has_referee_box())
        for referee in self.presence.pop_gone_referees():
            self._seat.forget(referee)
        self._services.process()
        roster = self.simulation.roster
        if (roster.names, roster.sides, roster.still) != (self._roster.names, self._roster.sides, self._roster.still):
            self._admission.add_robots(self._sides())
            self.inbox.set_roster(roster)
            self.presence.refresh_agents()
            self._outbox.set_roster(roster)
            self._silent = {name: self._silent.get(name, False) for name in roster.names}
        self._roster = roster

    def _sides(self) -> dict[str, Side]:
        roster = self.simulation.roster
        return dict(zip(roster.names, roster.sides, strict=True))

    def _while_waiting(self) -> None:
        """While the host waits for robots or recorders: publish batches that are due, and reply to requests."""
        self._services.serve_while_waiting()
        self._update_accounts()
        self._batches.send_if_due()

    def _update_accounts(self) -> None:
        """Count what the bus has refused, and allow all accounts the messages of the wall time that has passed."""
        now = self._clock.now()
        if now - self._accounts_updated_at >= HEALTH_S:
            self.accounts.add_refusals(self._bus.refusals.pop())
            self.accounts.pass_time(now - self._accounts_updated_at)
            self._accounts_updated_at = now

    def _send_sight(self, robot: str, sight: bytes) -> None:
        """Send a sight, before any other message of its tick: robots wait for sights, watchers do not."""
        if robot == self.simulation.roster.names[0]:
            self.inbox.sights_sent(self.simulation.world.tick, self._clock.unix_ns())
        self._outbox.publish_sight(robot, sight)

    def _look_for_sight_recorders(self) -> None:
        """Record sights if the match file demands it, or while a recorder requests them."""
        self._outbox.sights_recorded = self._config.record.sights or self.presence.wants_sights

    def _set_sim_time(self, tick: int) -> None:
        """Messages sent from now on have the simulated time of this tick."""
        self._clock.sim_ns = round(tick * self.simulation.profile.time.tick * 1e9)

    def _update_stats(self, tick: TickResult) -> None:
        """Count refusals; publish an event when an agent falls silent or answers, and when manual control changes."""
        self._reports.publish(tick)
        for name, count in tick.refused.items():
            self.inbox.agent_stats[name].refused += count
        for name, driven in self._manual.changes():
            text = f"{name} is under manual control" if driven else f"{name} is controlled by its brain again"
            self._reports.publish_on_agent(tick, name, "manual_control", text)
        for name, was_silent in self._silent.items():
            stats = self.inbox.agent_stats[name]
            if stats.idle:
                continue
            fell = not stats.alive or stats.silent >= self.pace.silent_ticks
            silent = fell or (was_silent and not stats.answering)
            if silent == was_silent:
                continue
            self._silent[name] = silent
            fault = stats.fault(tick.tick) if stats.alive else ""
            text = f"{name} does not answer, its robot stops{f': {fault}' if fault else ''}"
            self._reports.publish_on_agent(tick, name, "agent_silent", text if silent else f"{name} answers")

    def _report(self, tick: TickResult) -> None:
        """Publish the host's health when a report is due, and at most one invalid payload: a flood is not echoed."""
        self._update_accounts()
        invalid = self._admission.invalid_log.pop(tick.tick, tick.time)
        if invalid is not None:
            self._outbox.invalid.put(invalid)
        if self._health.end_tick(tick.time):
            self._publish_health(tick)

    def _publish_health(self, tick: TickResult) -> None:
        clients = self.inbox, self.presence, self._admission
        radio = self.simulation.radio_use, self.simulation.profile.radio.budget
        report = self._health.report(tick.tick, tick.time, self.pace.late_ticks, *clients, *radio)
        self._outbox.health.put(report.replace(paused=self._services.pause.is_paused))


def _pace(
    config: MatchConfig,
    bus: Bus,
    inbox: Inbox,
    presence: PresenceTracker,
    while_waiting: Callable[[], None],
    profile: Profile,
) -> Pace:
    if config.speed is None:
        return Lockstep(bus.clock, inbox, presence, config.patience, while_waiting)
    return Realtime(bus.clock, inbox, profile.time.tick, config.speed, profile.safety.watchdog)
