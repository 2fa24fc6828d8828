"""An agent's place in a match: the claim of its robot, which the host accepts or refuses."""

import os
import secrets
import socket

from schemas.bus.contract import Bus, NoReplyError, PresenceKind
from schemas.errors import TouchlineError
from schemas.messages.claim import AgentClaim, AgentClaimReply
from schemas.messages.setup import Setup
from schemas.tokens import SESSION_SEPARATOR
from schemas.topics import ROBOT_CLAIM

_REPLY_S = 4.0
"""Wall time that one query stays open: the host replies at once, or after the link of an earlier agent has expired."""


class Membership:
    """One agent in the match of its bus."""

    def __init__(self, bus: Bus, robot: str, launch_token: str | None) -> None:
        """`launch_token` is the secret of the launch; None without one."""
        self._bus = bus
        source = f"process {os.getpid()} on {socket.gethostname()}"[:80]
        side = bus.account.side if bus.account is not None else None
        session = f"{side.value if side is not None else 's'}{SESSION_SEPARATOR}{secrets.token_hex(12)}"
        self._claim = AgentClaim(robot=robot, session=session, launch_token=launch_token, source=source)
        self._is_declared = False

    def join(self, setup: Setup, patience: float) -> None:
        """Claim the robot; again for each host that the agent meets.

        Raises:
            TouchlineError: the host refuses, or does not reply for `patience` s of wall time.
        """
        side = self._bus.account.side if self._bus.account is not None else None
        if side is not None and self._claim.robot in setup.teams[side.opponent].robots:
            raise TouchlineError(
                f"{self._claim.robot} plays for {side.opponent}, and the credentials are those of {side}"
            )
        if not self._is_declared:
            self._declare(setup)
            self._is_declared = True
        if setup.claims:
            reply = self._ask(patience)
            if not reply.accepted:
                raise TouchlineError(f"{self._claim.robot}: refused by the host: {reply.reason}")

    def _declare(self, setup: Setup) -> None:
        """Declare the liveliness token; a host that is older than claims knows those of robots only."""
        if setup.claims:
            self._bus.declare_alive(PresenceKind.SESSION, self._claim.session)
        else:
            self._bus.declare_alive(PresenceKind.AGENT, self._claim.robot)

    def _ask(self, patience: float) -> AgentClaimReply:
        clock = self._bus.clock
        deadline = clock.now() + max(patience, _REPLY_S)
        while True:
            try:
                query = self._bus.query(ROBOT_CLAIM, self._claim, timeout=_REPLY_S, robot=self._claim.robot)
                reply: AgentClaimReply = query.result(_REPLY_S + 0.5)
            except NoReplyError as error:
                if clock.now() >= deadline:
                    raise TouchlineError(
                        f"{self._claim.robot}: the host does not reply to the agent's claim ({error})"
                    ) from None
                clock.sleep_until(clock.now() + 0.1)
            else:
                return reply
