"""The handler of agents' claims. A claim of a robot that has an agent waits until that agent's link would have expired.

An agent that is restarted elsewhere after a broken cable gets its robot as soon as its earlier session expires. A
second agent is refused.
"""

from dataclasses import dataclass
from typing import NamedTuple

from runtime.bus.contract import Bus, Query
from runtime.process.timing import LINK_GRACE_S
from schemas.messages.claim import AgentClaim, AgentClaimReply
from schemas.topics import CLAIM, ROBOT_CLAIM
from schemas.wire.message import BadMessageError
from sim_host.server.admission.claims import Claims
from sim_host.server.admission.invalid_log import InvalidLog

_MOST = 200
"""Most claims that wait, and most refused sessions that are remembered."""
_MOST_UNREADABLE = 20
"""Most reasons of claims that could not be read that are reported."""


class RefusedAgent(NamedTuple):
    """An agent that was refused."""

    robot: str | None
    """The robot that it claimed; None if its claim could not be read."""
    text: str
    """Who was refused, and why."""


@dataclass(frozen=True, slots=True)
class _Waiting:
    query: Query
    claim: AgentClaim
    until: float


class ClaimHandler:
    """Receives claims, decides them, and replies."""

    def __init__(self, bus: Bus, claims: Claims, invalid_log: InvalidLog) -> None:
        self._servers = (bus.serve(ROBOT_CLAIM), bus.serve(CLAIM))
        self._clock = bus.clock
        self._claims = claims
        self._invalid_log = invalid_log
        self._waiting: list[_Waiting] = []
        self._refused: dict[str, None] = {}
        self._unreadable: set[str] = set()
        self.refusals: list[RefusedAgent] = []
        """Refused agents that have not been reported yet."""

    def receive(self) -> None:
        """Receive claims. Call it before changes of presence are read: a session's token arrives before its claim."""
        for query in (query for server in self._servers for query in iter(server.receive, None)):
            try:
                claim: AgentClaim = query.message()
            except BadMessageError as error:
                self._invalid_log.add(query.key, str(error), query.payload)
                query.fail(str(error))
                self.add_refusal(f"an agent was refused: {error}")
                continue
            if len(self._waiting) >= _MOST:
                query.reply(AgentClaimReply(accepted=False, reason="too many agents claim robots at the same time"))
                continue
            waiting = _Waiting(query, claim, self._clock.now() + LINK_GRACE_S)
            if _is_on_its_key(query, claim):
                self._waiting.append(waiting)
            else:
                reason = self._claims.refusal(claim) or f"{query.key} claims {claim.robot}; use the robot's own key"
                self._refuse(waiting, reason)

    def decide(self) -> list[str]:
        """Decide the received claims; returns the robots that were granted."""
        if not self._waiting:
            return []
        waiting, self._waiting = self._waiting, []
        granted = []
        now = self._clock.now()
        for one in waiting:
            reason = self._claims.refusal(one.claim)
            obstacle = reason or self._claims.obstacle(one.claim)
            if not obstacle:
                self._claims.grant(one.claim)
                granted.append(one.claim.robot)
                one.query.reply(AgentClaimReply(accepted=True))
            elif reason or now >= one.until:
                self._refuse(one, obstacle)
            else:
                self._waiting.append(one)
        return granted

    def _refuse(self, one: _Waiting, reason: str) -> None:
        one.query.reply(AgentClaimReply(accepted=False, reason=reason))
        claim = one.claim
        if claim.session in self._refused or len(self._refused) >= _MOST:
            return
        self._refused[claim.session] = None
        described = ", ".join(filter(None, (claim.source, claim.program)))
        source = f" ({described})" if described else ""
        self.refusals.append(
            RefusedAgent(claim.robot, f"an agent{source} that claimed {claim.robot} was refused: {reason}")
        )

    def add_refusal(self, text: str) -> None:
        """Report a process that was refused without a valid claim; once for each text."""
        if text not in self._unreadable and len(self._unreadable) < _MOST_UNREADABLE:
            self._unreadable.add(text)
            self.refusals.append(RefusedAgent(None, text))


def _is_on_its_key(query: Query, claim: AgentClaim) -> bool:
    """Whether a claim came on the key of the robot that it claims, to which only agents of its side have access."""
    robot = query.topic.match(query.key) or {}
    return robot.get("robot", claim.robot) == claim.robot
