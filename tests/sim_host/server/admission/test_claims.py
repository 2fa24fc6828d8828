"""Claims: a robot has one agent at a time, and the host alone decides which."""

from contextlib import suppress

import pytest

from robot_agent.process.runner import Runner
from runtime.bus.contract import NoReplyError, PresenceKind, RefusedQueryError
from runtime.process.timing import LINK_GRACE_S
from schemas.config.match_config import MatchConfig
from schemas.messages.claim import AgentClaim
from schemas.messages.setup import SetupRequest
from schemas.soccer.game import EventKind
from schemas.topics import CLAIM, EVENT, SETUP
from support.host_rig import TEAMS, Agent, Forward, HostRig

SECRET = "a secret of the launch"
SOURCE = "process {number} on lab3"


class Claimant:
    """An agent that claims a robot before it plays."""

    def __init__(self, rig, robot, number, launch_token=None, **started_for):
        self.rig, self.robot, self.bus = rig, robot, rig.seat()
        self.session = f"s{number}"
        self.bus.declare_alive(PresenceKind.SESSION, self.session)
        self._claim = AgentClaim(
            robot=robot,
            session=self.session,
            launch_token=launch_token,
            source=SOURCE.format(number=number),
            **started_for,
        )
        self.claim()

    def claim(self, robot=None):
        claim = self._claim.replace(robot=robot or self.robot)
        self._pending, self._reply = self.bus.query(CLAIM, claim), None

    def play(self):
        self.rig.agents[self.robot] = Agent(self.bus, Runner(self.bus, Forward(), self.robot))

    @property
    def reply(self):
        """The host's reply; None while it has sent none."""
        with suppress(NoReplyError):
            self._reply = self._reply or self._pending.result(0.0)
        return self._reply


@pytest.fixture
def launch():
    """A host that admits agents of its launch only."""
    rig = HostRig(MatchConfig.model_validate({"seed": 7, "teams": TEAMS}), launch_token=SECRET)
    rig.host.begin()
    yield rig
    rig.host.simulation.close()


@pytest.fixture
def open_rig(rig_of):
    """A host that admits every agent, at tick 0."""
    rig = rig_of(patience={"answer": 1.0})  # those who claim in these tests answer no sight
    rig.host.begin()
    return rig


def test_the_setup_reports_that_agents_claim_their_robot(open_rig):
    reply = open_rig.seat().query(SETUP, SetupRequest())
    open_rig.ticks(1)
    assert reply.result(0.0).claims


def test_an_agent_that_has_claimed_its_robot_is_waited_for(open_rig):
    agent = Claimant(open_rig, "cyan1", 1)
    agent.play()
    open_rig.ticks(1)
    assert agent.reply.accepted
    open_rig.ticks(5)
    stats = open_rig.host.inbox.agent_stats["cyan1"]
    assert stats.alive and stats.newest == open_rig.host.simulation.now.tick - 1


def test_a_second_agent_of_a_robot_is_refused_by_name_on_both_ends(open_rig):
    events = open_rig.listen(EVENT)
    first = Claimant(open_rig, "cyan1", 1)
    first.play()
    open_rig.ticks(1)
    second = Claimant(open_rig, "cyan1", 2)
    open_rig.ticks(1)
    assert second.reply is None
    open_rig.pass_time(LINK_GRACE_S)
    open_rig.ticks(2)
    reason = "cyan1 has an agent already: process 1 on lab3"
    assert (second.reply.accepted, second.reply.reason) == (False, reason)
    assert [event.text for event in events.all() if event.kind is EventKind.AGENT and event.rule == "claim"] == [
        f"an agent (process 2 on lab3) that claimed cyan1 was refused: {reason}"
    ]
    assert open_rig.host.inbox.agent_stats["cyan1"].alive


def test_an_agent_that_is_started_again_gets_its_robot_at_once(open_rig):
    first = Claimant(open_rig, "cyan1", 1)
    open_rig.ticks(1)
    first.bus.close()
    second = Claimant(open_rig, "cyan1", 2)
    open_rig.ticks(1)
    assert second.reply.accepted


def test_all_robots_of_a_program_that_has_ended_may_be_claimed(open_rig):
    program = Claimant(open_rig, "cyan1", 1)
    program.claim("cyan2")
    open_rig.ticks(1)
    assert program.reply.accepted
    program.bus.close()
    others = [Claimant(open_rig, robot, number) for number, robot in ((2, "cyan1"), (3, "cyan2"))]
    open_rig.ticks(1)
    assert [other.reply and other.reply.accepted for other in others] == [True, True]


def test_a_claim_is_granted_as_soon_as_the_link_of_the_earlier_agent_expires(open_rig):
    first = Claimant(open_rig, "cyan1", 1)
    open_rig.ticks(1)
    second = Claimant(open_rig, "cyan1", 2)
    open_rig.pass_time(LINK_GRACE_S / 2)
    open_rig.ticks(1)
    assert second.reply is None
    first.bus.close()
    open_rig.ticks(1)
    assert second.reply.accepted


def test_of_two_agents_that_claim_a_robot_at_the_same_time_one_gets_it(open_rig):
    claimants = [Claimant(open_rig, "cyan1", number) for number in (1, 2)]
    open_rig.ticks(1)
    open_rig.pass_time(LINK_GRACE_S)
    open_rig.ticks(1)
    assert [claimant.reply.accepted for claimant in claimants] == [True, False]


def test_a_claim_may_be_repeated(open_rig):
    agent = Claimant(open_rig, "cyan1", 1)
    open_rig.ticks(1)
    agent.claim()
    open_rig.ticks(1)
    assert agent.reply.accepted


def test_an_agent_whose_link_was_broken_has_its_robot_back(open_rig):
    agent = Claimant(open_rig, "cyan1", 1)
    stats = open_rig.host.inbox.agent_stats["cyan1"]
    present = []
    for change in (lambda *_: None, agent.bus.withdraw_alive, agent.bus.declare_alive):
        change(PresenceKind.SESSION, agent.session)
        open_rig.ticks(1)
        present.append(stats.alive)
    assert present == [True, False, True]


def test_an_agent_whose_robot_was_claimed_meanwhile_does_not_get_it_back(open_rig):
    first = Claimant(open_rig, "cyan1", 1)
    open_rig.ticks(1)
    first.bus.withdraw_alive(PresenceKind.SESSION, first.session)
    second = Claimant(open_rig, "cyan1", 2)
    open_rig.ticks(1)
    first.bus.declare_alive(PresenceKind.SESSION, first.session)
    first.claim()
    open_rig.ticks(1)
    open_rig.pass_time(LINK_GRACE_S)
    open_rig.ticks(1)
    assert second.reply.accepted
    assert first.reply.reason == "cyan1 has an agent already: process 2 on lab3"


def test_a_claim_without_a_session_is_refused(open_rig):
    agent = Claimant(open_rig, "cyan1", 1)
    agent.bus.withdraw_alive(PresenceKind.SESSION, agent.session)
    open_rig.ticks(1)
    open_rig.pass_time(LINK_GRACE_S)
    open_rig.ticks(1)
    assert agent.reply.reason == "the liveliness token alive/session/s1 is missing; declare it before the claim"


def test_a_robot_with_an_agent_that_makes_no_claims_is_not_given_to_another(open_rig):
    plain = open_rig.join("cyan1")
    agent = Claimant(open_rig, "cyan1", 1)
    open_rig.ticks(1)
    open_rig.pass_time(LINK_GRACE_S)
    open_rig.ticks(1)
    assert agent.reply.reason == "cyan1 has an agent already, which has made no claim"
    assert plain.runner.answered == 2


@pytest.mark.parametrize("token", [None, "", "another secret"])
def test_a_launch_admits_its_own_agents_only(launch, token):
    events = launch.listen(EVENT)
    own, other = Claimant(launch, "cyan1", 1, SECRET), Claimant(launch, "cyan2", 2, token)
    launch.ticks(1)
    reason = "the host admits only agents of its own launch, which know TOUCHLINE_LAUNCH_TOKEN"
    assert own.reply.accepted
    assert (other.reply.accepted, other.reply.reason) == (False, reason)
    assert [event.robot for event in events.all() if event.rule == "claim"] == ["cyan2"]
    assert SECRET not in other.reply.reason


@pytest.mark.parametrize(
    ("robot", "started_for", "reason"),
    [
        ("magenta9", {}, 'no robot of the match "friendly" is named magenta9; did you mean "magenta1"?'),
        ("cyan1", {"side": "magenta"}, "cyan1 is a robot of cyan, and the agent plays for magenta"),
        ("cyan1", {"match": "final"}, 'the agent is for the match "final", and this host plays "friendly"'),
    ],
    ids=["an unknown robot", "a robot of the other side", "another match"],
)
def test_a_claim_that_does_not_fit_is_refused_at_once_with_the_reason_on_both_ends(
    open_rig, robot, started_for, reason
):
    events = open_rig.listen(EVENT)
    agent = Claimant(open_rig, robot, 1, program="touchline 0.1.0", **started_for)
    open_rig.ticks(1)
    assert (agent.reply.accepted, agent.reply.reason) == (False, reason)
    assert [event.text for event in events.all() if event.rule == "claim"] == [
        f"an agent (process 1 on lab3, touchline 0.1.0) that claimed {robot} was refused: {reason}"
    ]


def test_an_agent_of_this_match_and_side_is_admitted(open_rig):
    agent = Claimant(open_rig, "magenta1", 1, match="friendly", side="magenta")
    open_rig.ticks(1)
    assert agent.reply.accepted


@pytest.mark.parametrize("topic", [CLAIM, SETUP])
def test_a_process_of_another_version_is_refused_with_both_versions_on_both_ends(open_rig, topic):
    events = open_rig.listen(EVENT)
    request = AgentClaim(robot="cyan1", session="s1") if topic is CLAIM else SetupRequest()
    bus = open_rig.seat()
    replies = [bus.query(topic, request.replace(version="3.0")) for _ in range(3)]
    open_rig.ticks(2)
    reason = "version 3.0 is not supported, this side has 2.0; update the older side"
    for reply in replies:
        with pytest.raises(RefusedQueryError, match=reason):
            reply.result(0.0)
    (text,) = [event.text for event in events.all() if event.rule == "claim"]
    assert text.endswith(reason)


def test_the_other_team_of_a_launch_needs_no_secret_where_it_is_remote():
    teams = {"cyan": TEAMS["cyan"], "magenta": {**TEAMS["magenta"], "remote": True}}
    rig = HostRig(MatchConfig.model_validate({"seed": 7, "teams": teams}), launch_token=SECRET)
    rig.host.begin()
    guest, intruder = Claimant(rig, "magenta1", 1), Claimant(rig, "cyan1", 2)
    rig.ticks(1)
    assert (guest.reply.accepted, intruder.reply.accepted) == (True, False)
    rig.host.simulation.close()


def test_a_launch_neither_waits_for_nor_obeys_an_agent_that_has_made_no_claim(launch):
    began = launch.clock.now()
    launch.join("cyan1")
    launch.ticks(3)
    stats = launch.host.inbox.agent_stats["cyan1"]
    assert (stats.alive, stats.answers) == (False, 0)
    assert launch.clock.now() == began


def test_a_claim_that_cannot_be_read_is_refused_with_the_reason(open_rig):
    bus = open_rig.seat()
    reply = bus.query(CLAIM, SetupRequest())
    open_rig.ticks(1)
    with pytest.raises(NoReplyError, match="AgentClaim: robot is missing"):
        reply.result(0.0)
