"""Which agent plays which robot: decides the claims of agents. Knows no bus."""

from dataclasses import dataclass, field

from schemas.messages.claim import AgentClaim
from sim_host.server.admission.eligibility import Eligibility

_MOST = 200
"""Most robots, and most sessions, that are remembered; a flood of invented names must not fill the memory."""


@dataclass(frozen=True, slots=True)
class Holder:
    """The agent of a robot."""

    session: str
    source: str


@dataclass(slots=True)
class Claims:
    """The agents of all robots. An agent loses its robots when its session ends, and at no other time.

    A session whose link was broken gets each robot back that no other agent has claimed meanwhile.
    """

    eligibility: Eligibility
    """Which claims fit the match."""
    holders: dict[str, Holder] = field(default_factory=dict)
    """Robot → its agent."""
    _unclaimed: set[str] = field(default_factory=set)
    """Robots with the token of an agent that makes no claims."""
    _sessions: set[str] = field(default_factory=set)
    _former: dict[str, dict[str, Holder]] = field(default_factory=dict)
    """Session that is gone → its robots."""

    def set_session(self, session: str, alive: bool) -> list[str]:
        """A session's liveliness token appeared or disappeared; returns the robots that change with it."""
        return self._restore(session) if alive else self._release(session)

    def set_unclaimed(self, robot: str, alive: bool) -> None:
        """The token of a robot's agent that makes no claims appeared or disappeared."""
        if not alive:
            self._unclaimed.discard(robot)
        elif len(self._unclaimed) < _MOST:
            self._unclaimed.add(robot)

    def is_present(self, robot: str) -> bool:
        """Whether the robot has an agent that may play it."""
        return robot in self.holders or (robot in self._unclaimed and not self.eligibility.needs_token(robot))

    def admits(self, robot: str) -> bool:
        """Whether commands on this robot's key are from an agent that may play it, as far as the host can know."""
        return robot in self.holders or not self.eligibility.needs_token(robot)

    def refusal(self, claim: AgentClaim) -> str:
        """Why the claim cannot succeed at any time; empty if it can."""
        reason = self.eligibility.refusal(claim)
        if not reason and claim.robot not in self.holders and len(self.holders) >= _MOST:
            return f"the host has {_MOST} agents already"
        return reason

    def obstacle(self, claim: AgentClaim) -> str:
        """Why the claim does not succeed at present; empty if it does."""
        holder = self.holders.get(claim.robot)
        if claim.session not in self._sessions:
            return f"the liveliness token alive/session/{claim.session} is missing; declare it before the claim"
        if holder is not None:
            return "" if holder.session == claim.session else f"{claim.robot} has an agent already: {holder.source}"
        if claim.robot in self._unclaimed and not self.eligibility.needs_token(claim.robot):
            return f"{claim.robot} has an agent already, which has made no claim"
        return ""

    def grant(self, claim: AgentClaim) -> None:
        """Make the robot the agent's."""
        described = ", ".join(filter(None, (claim.source, claim.program)))
        self.holders[claim.robot] = Holder(claim.session, described or "an agent without a description")

    def source(self, robot: str) -> str:
        """The agent of a robot, as it has described itself; empty for one that has made no claim."""
        holder = self.holders.get(robot)
        return holder.source if holder is not None else ""

    def _restore(self, session: str) -> list[str]:
        if len(self._sessions) < _MOST:
            self._sessions.add(session)
        former = self._former.pop(session, {})
        return [robot for robot, holder in former.items() if self.holders.setdefault(robot, holder) is holder]

    def _release(self, session: str) -> list[str]:
        self._sessions.discard(session)
        held = {robot: holder for robot, holder in self.holders.items() if holder.session == session}
        for robot in held:
            del self.holders[robot]
        if held:
            while len(self._former) >= _MOST:
                del self._former[next(iter(self._former))]
            self._former[session] = held
        return list(held)
