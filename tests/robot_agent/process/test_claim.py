"""An agent claims its robot before it plays, and ends with one line where the host refuses it."""

import threading

import pytest

from robot_agent.process.claim import Membership
from runtime.bus.contract import PresenceKind
from schemas.errors import TouchlineError
from schemas.messages.claim import AgentClaimReply
from schemas.side import Side
from schemas.topics import ROBOT_CLAIM
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


class ClaimHost:
    """A host that replies to every claim in the same way, and keeps what it receives."""

    def __init__(self, reply):
        network = SharedState()
        self.bus, self.agent_bus = (network.open_bus("friendly", SteppedClock()) for _ in range(2))
        self.presence, self.claims = self.bus.watch_alive(), []
        self._server = self.bus.serve(ROBOT_CLAIM)
        self._reply = reply
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def _serve(self):
        while (query := self._server.receive(None)) is not None:
            self.claims.append(query.message())
            query.reply(self._reply)

    def close(self):
        self.agent_bus.close()
        self.bus.close()
        self._thread.join()


@pytest.fixture
def host_of():
    """Makes a host with this reply to claims."""
    made = []

    def make(**reply):
        made.append(ClaimHost(AgentClaimReply(**reply)))
        return made[-1]

    yield make
    for host in made:
        host.close()


def test_an_agent_claims_its_robot_for_a_session_of_its_own(host_of, setup):
    host = host_of(accepted=True)
    claiming = setup.replace(claims=True)
    for _ in range(2):
        Membership(host.agent_bus, "cyan1", "secret").join(claiming, 1.0)
    tokens = [host.presence.receive(1.0) for _ in range(2)]
    assert [(claim.robot, claim.launch_token) for claim in host.claims] == [("cyan1", "secret")] * 2
    assert [(token.kind, token.name) for token in tokens] == [
        (PresenceKind.SESSION, claim.session) for claim in host.claims
    ]
    assert len({claim.session for claim in host.claims}) == 2
    assert host.claims[0].source.startswith("process ")


def test_an_agent_claims_its_robot_again_of_each_host_for_the_same_session(host_of, setup):
    host = host_of(accepted=True)
    member = Membership(host.agent_bus, "cyan1", None)
    for _ in range(2):
        member.join(setup.replace(claims=True), 1.0)
    assert host.claims[0] == host.claims[1]


def test_a_refused_agent_ends_with_the_reason(host_of, setup):
    host = host_of(accepted=False, reason="cyan1 has an agent already: process 4711 on lab3")
    with pytest.raises(TouchlineError) as error:
        Membership(host.agent_bus, "cyan1", None).join(setup.replace(claims=True), 1.0)
    assert str(error.value) == "cyan1: refused by the host: cyan1 has an agent already: process 4711 on lab3"


def test_an_agent_reports_match_side_and_program(host_of, setup):
    host = host_of(accepted=True)
    Membership(host.agent_bus, "cyan1", None, "final", Side.CYAN).join(setup.replace(claims=True), 1.0)
    (claim,) = host.claims
    assert (claim.match, claim.side) == ("final", Side.CYAN)
    assert claim.program.startswith("touchline ")


def test_an_agent_of_a_host_without_claims_declares_the_token_of_its_robot(host_of, setup):
    host = host_of(accepted=False)
    Membership(host.agent_bus, "cyan1", None).join(setup, 1.0)
    token = host.presence.receive(1.0)
    assert (token.kind, token.name, host.claims) == (PresenceKind.AGENT, "cyan1", [])
