"""Presence of a host: a broken link does not mean that the host has left."""

from dataclasses import dataclass, field

import pytest

from runtime.bus.contract import PresenceKind
from runtime.bus.host_watch import HostWatch
from runtime.process.timing import CUT_OFF_S, LINK_GRACE_S
from support.in_process_bus import InProcessBus, SharedState
from support.stepped_clock import SteppedClock


@dataclass
class Client:
    """A bus whose link can break, and the host's token."""

    host: InProcessBus
    bus: InProcessBus
    linked: bool = True
    cut_off: bool = False
    watch: HostWatch = field(init=False)

    def __post_init__(self) -> None:
        self.bus.connected = lambda: self.linked
        self.bus.is_cut_off = lambda: self.cut_off
        self.watch = HostWatch(self.bus)

    def come(self) -> None:
        self.host.declare_alive(PresenceKind.HOST, "host")

    def go(self) -> None:
        self.host.withdraw_alive(PresenceKind.HOST, "host")

    def unreachable_after(self, seconds: float) -> float:
        """For how long the host was not reachable when it was looked for twenty times a second, for so long."""
        clock, reached_at = self.bus.clock, self.bus.clock.now()
        for _ in range(round(seconds * 20)):
            clock.sleep_until(clock.now() + 0.05)
            self.watch.update()
            if self.watch.is_reachable():
                reached_at = clock.now()
        return clock.now() - reached_at

    def given_up_after(self, longest: float) -> float | None:
        """The wall time after which an agent with a patience of 10 s gives the match up; None if it does not."""
        clock = self.bus.clock
        for number in range(round(longest * 4)):
            self.watch.update()
            if not self.watch.is_reachable() and self.watch.is_given_up(10.0):
                return number / 4
            clock.sleep_until(clock.now() + 0.25)
        return None


@pytest.fixture
def client() -> Client:
    medium = SharedState()
    return Client(medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock()))


@pytest.fixture
def met(client) -> Client:
    """The host is there."""
    client.come()
    assert client.unreachable_after(1.0) == 0.0
    return client


def test_a_host_whose_token_was_never_seen_is_reachable_while_the_link_is_up(client):
    assert client.unreachable_after(20.0) == 0.0
    assert not client.watch.seen
    client.linked = False
    assert client.unreachable_after(3.0) == pytest.approx(3.0)


@pytest.mark.parametrize("token", [True, False], ids=["with its token", "with its token gone"])
def test_a_host_behind_a_broken_link_is_not_reachable(met, token):
    met.linked = False
    if not token:
        met.go()
    assert met.unreachable_after(4.0) == pytest.approx(4.0)


def test_a_host_is_reachable_again_when_both_link_and_token_are_back(met):
    met.linked = False
    met.go()
    met.unreachable_after(4.0)
    met.linked = True
    assert met.unreachable_after(0.5) == pytest.approx(0.5), "the token is missing"
    met.come()
    assert met.unreachable_after(0.1) == 0.0


def test_time_in_which_the_process_was_suspended_does_not_count(met):
    met.linked = False
    met.go()
    met.unreachable_after(1.0)
    met.bus.clock.sleep_until(met.bus.clock.now() + 60.0)
    assert met.given_up_after(20.0) == pytest.approx(9.0, abs=1.0)


def test_a_host_that_went_and_is_back_is_noticed_once(met):
    assert not met.watch.update()
    met.go()
    met.come()
    assert met.watch.update()
    assert not met.watch.update()
    assert met.watch.is_reachable()


def test_other_processes_are_no_hosts(client):
    for kind in PresenceKind:
        if kind is not PresenceKind.HOST:
            client.host.declare_alive(kind, "one")
    client.watch.update()
    assert not client.watch.seen


def test_for_a_watcher_a_host_that_was_never_seen_has_not_left(client):
    assert not client.watch.has_left()
    client.linked = False
    client.bus.clock.sleep_until(60.0)
    assert not client.watch.has_left()


def test_for_a_watcher_a_host_leaves_with_its_token(met):
    assert not met.watch.has_left()
    met.go()
    assert met.watch.has_left()


def test_a_watcher_gives_a_broken_link_a_moment_to_come_back(met):
    assert not met.watch.has_left()
    met.linked = False
    left = []
    for _ in range(round((LINK_GRACE_S + 0.5) * 20)):
        met.bus.clock.sleep_until(met.bus.clock.now() + 0.05)
        left.append(met.watch.has_left())
    assert left.index(True) == pytest.approx(LINK_GRACE_S * 20, abs=2)
    met.linked = True
    assert not met.watch.has_left()


def test_who_waits_for_a_host_waits_as_long_as_its_patience(client):
    assert not client.watch.wait(3.0)
    assert client.bus.clock.now() == pytest.approx(3.0, abs=0.1)
    client.come()
    assert client.watch.wait(0.0)


def test_an_agent_gives_up_a_host_that_is_gone(met):
    met.linked = False
    assert met.given_up_after(20.0) == pytest.approx(10.0, abs=0.5)


def test_an_agent_does_not_give_up_a_host_from_which_it_is_cut_off(met):
    met.linked, met.cut_off = False, True
    assert met.given_up_after(600.0) is None
    met.cut_off = False
    assert met.given_up_after(20.0) == pytest.approx(10.0, abs=1.5), "its patience begins when the network is back"


def test_an_agent_gives_up_a_machine_that_never_comes_back(met):
    met.linked, met.cut_off = False, True
    assert met.given_up_after(CUT_OFF_S + 60.0) == pytest.approx(CUT_OFF_S + 10.0, abs=2.0)
