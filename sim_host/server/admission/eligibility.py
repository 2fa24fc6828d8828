"""What the claim of an agent has to fit: match, robots, sides, and the secret of the launch. Knows no bus."""

import hmac
from dataclasses import dataclass, field

from schemas.config.match_config import MatchConfig
from schemas.errors import did_you_mean
from schemas.messages.claim import AgentClaim
from schemas.side import Side


@dataclass(slots=True)
class Eligibility:
    """Which claims fit this match, whatever other agents do."""

    match: str
    """Name of the match."""
    sides: dict[str, Side]
    """Robot → its side, for each robot that takes part or has taken part."""
    launch_token: str | None = None
    """Secret that an agent must know; None admits every agent."""
    remote: frozenset[Side] = field(default_factory=frozenset)
    """Sides whose agents are of another launch, and need no secret."""

    @classmethod
    def of(cls, config: MatchConfig, launch_token: str | None) -> "Eligibility":
        """The claims that fit the match of a config."""
        sides = {robot: side for side in Side for robot in config.robots(side)}
        return cls(config.name, sides, launch_token, frozenset(config.remote_sides))

    def needs_token(self, robot: str) -> bool:
        """Whether the agent of this robot must know the secret of the launch."""
        return self.launch_token is not None and self.sides.get(robot) not in self.remote

    def refusal(self, claim: AgentClaim) -> str:
        """Why the claim does not fit; empty if it does."""
        if claim.match not in (None, self.match):
            return f'the agent is for the match "{claim.match}", and this host plays "{self.match}"'
        side = self.sides.get(claim.robot)
        if side is None:
            return (
                f'no robot of the match "{self.match}" is named {claim.robot}; {did_you_mean(claim.robot, self.sides)}'
            )
        if claim.side not in (None, side):
            return f"{claim.robot} is a robot of {side}, and the agent plays for {claim.side}"
        given = (claim.launch_token or "").encode()
        if self.needs_token(claim.robot) and not hmac.compare_digest(given, (self.launch_token or "").encode()):
            return "the host admits only agents of its own launch, which know TOUCHLINE_LAUNCH_TOKEN"
        return ""
