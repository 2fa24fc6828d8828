"""Limits of links: which one floods, who is refused after that and for how long, and what honest links may carry."""

from schemas.bus.links import Link
from schemas.messages.health import ConnectionHealth
from sim_host.server.link_limits import FIRST_REFUSAL_S, MOST_EXTRA_RATE, PERIODS, READ_FACTOR, LinkLimits

PERIOD_S = 0.25
FLOOD = int(10 * MOST_EXTRA_RATE * PERIOD_S)
"""Bytes of a flood in a period."""


class Play:
    """Links over time, whose received bytes grow."""

    def __init__(self, **settings):
        self.limits = LinkLimits(**settings)
        self.now = 100.0
        self.received = {}
        self.period()

    def open(self, client, port, address="10.0.0.1"):
        """A new link; returns whether it is refused."""
        link = Link(client, address, port)
        if self.limits.is_refused(link, self.now):
            return True
        self.received[link] = 0
        return False

    def period(self, read=0, **sent):
        """A period in which clients send these bytes; returns the clients whose links were closed."""
        for link in self.received:
            self.received[link] += sent.get(link.client, 0)
        self.now += PERIOD_S
        floods = self.limits.end_period(dict(self.received), read, self.now)
        for flood in floods:
            del self.received[flood.link]
        return [flood.link.client for flood in floods]

    def periods(self, count, **sent):
        return [client for _ in range(count) for client in self.period(**sent)]


def test_only_the_link_that_floods_is_closed_after_some_periods_in_a_row():
    play = Play()
    play.open("honest", 1)
    play.open("flooder", 2)
    assert play.periods(PERIODS - 1, flooder=FLOOD, honest=1000) == []
    assert play.period(flooder=FLOOD, honest=1000) == ["flooder"]
    assert play.periods(20, honest=1000) == []
    assert play.limits.health() == {"10.0.0.1": ConnectionHealth(closed=1)}


def test_a_burst_as_after_a_cut_of_the_network_closes_no_link():
    play = Play()
    play.open("robot", 1)
    for _ in range(5):
        assert play.periods(PERIODS - 1, robot=FLOOD) == []
        assert play.period() == []


def test_a_link_may_carry_as_much_as_the_host_reads():
    play = Play()
    play.open("robots", 1)
    read = 5_000_000
    assert play.periods(20, robots=int(READ_FACTOR * read), read=read) == []


def test_a_long_period_as_after_a_pause_of_the_host_allows_as_much_more():
    play = Play()
    play.open("robot", 1)
    for _ in range(2 * PERIODS):
        play.now += 60.0
        assert play.period(robot=FLOOD) == []


def test_the_bytes_before_the_first_period_are_no_flood():
    limits, link = LinkLimits(), Link("robot", "10.0.0.1", 1)
    assert limits.end_period({link: 10**12}, 0, 5.0) == []
    for number in range(20):
        assert limits.end_period({link: 10**12 + number}, 0, 5.25 + number * PERIOD_S) == []


def test_a_client_whose_link_was_closed_is_refused_for_longer_each_time():
    play, refusals = Play(), []
    for port in range(3):
        assert not play.open("flooder", port)
        while play.period(flooder=FLOOD) == []:
            pass
        began = play.now
        while play.limits.is_refused(Link("flooder", "10.0.0.1", 99), play.now):
            play.period()
        refusals.append(play.now - began)
    assert refusals == [FIRST_REFUSAL_S, 2 * FIRST_REFUSAL_S, 4 * FIRST_REFUSAL_S]


def test_a_client_that_has_returned_and_floods_again_is_closed_at_once():
    play = Play()
    play.open("flooder", 1)
    play.periods(PERIODS, flooder=FLOOD)
    play.periods(int(FIRST_REFUSAL_S / PERIOD_S) + 1)
    assert not play.open("flooder", 2)
    assert play.period(flooder=FLOOD) == ["flooder"]


def test_one_flood_does_not_refuse_other_clients_of_its_address():
    play = Play()
    play.open("flooder", 1)
    play.periods(PERIODS, flooder=FLOOD)
    assert not play.open("other", 2)


def test_under_new_names_a_flooder_is_refused_and_known_clients_and_other_addresses_are_not():
    play = Play()
    play.open("mate", 1)
    play.periods(30, mate=1000)
    play.open("flooder1", 2)
    play.periods(PERIODS, flooder1=FLOOD)
    play.open("flooder2", 3)
    assert play.period(flooder2=FLOOD) == ["flooder2"]
    assert play.open("flooder3", 4)
    assert not play.open("mate", 5)
    assert not play.open("elsewhere", 6, address="10.0.0.2")
    assert play.limits.health()["10.0.0.1"] == ConnectionHealth(closed=2, refused=1)


def test_new_names_without_end_leave_an_attacker_little_of_the_time():
    play, open_periods = Play(), 0
    for number in range(4000):
        play.open(f"flooder{number}", number)
        client = {link.client: FLOOD for link in play.received}
        open_periods += bool(client)
        play.period(**client)
    assert open_periods / 4000 < 0.05


def test_unknown_clients_of_an_address_get_in_again_while_the_attack_goes_on():
    play, joined = Play(), 0
    for number in range(400):
        play.open(f"flooder{number}", number)
        joined += not play.open(f"robot{number}", 10_000 + number)
        play.period(**{link.client: FLOOD for link in play.received if link.client.startswith("flooder")})
    assert joined > 400 * PERIOD_S / 10.0  # an agent tries for ten seconds


def test_a_forgiving_host_closes_and_refuses_no_link():
    play = Play(forgiving=True)
    play.open("flooder", 1)
    assert play.periods(50, flooder=FLOOD) == []
    assert not play.open("flooder", 2)
    assert play.limits.health() == {}


def test_reports_do_not_grow_with_the_addresses_of_a_network():
    play = Play()
    for number in range(200):
        play.open(f"flooder{number}", 1, address=f"10.0.1.{number}")
    for _ in range(PERIODS):
        play.period(**{link.client: FLOOD for link in play.received})
    health = play.limits.health()
    assert len(health) < 30
    assert sum(counts.closed for counts in health.values()) == 200
