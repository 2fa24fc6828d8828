"""An agent's place in a match: the claim of its robot, which the host accepts or refuses."""

import os
import secrets
import socket

from robot_agent.process.timing import CLAIM_REPLY_S
from runtime.access.accounts import Account
from runtime.bus.contract import Bus, NoReplyError, PresenceKind, RefusedQueryError
from runtime.process.installed import installed_version
from runtime.process.timing import SLICE_S
from schemas.errors import TouchlineError
from schemas.messages.claim import AgentClaim, AgentClaimReply
from schemas.messages.setup import Setup
from schemas.side import Side
from schemas.tokens import SESSION_SEPARATOR
from schemas.topics import ROBOT_CLAIM


class Membership:
    """One agent in the match of its bus."""

    def __init__(
        self, bus: Bus, robot: str, launch_token: str | None, match: str | None = None, side: Side | None = None
    ) -> None:
        """`launch_token` is the secret of the launch; None without one.

        `match` and `side` are those that the agent was started for; None for any.
        """
        self._bus = bus
        source = f"process {os.getpid()} on {socket.gethostname()}"[:80]
        own = bus.account.side if bus.account is not None else None
        self._claim = AgentClaim(
            robot=robot,
            session=f"{own.value if own is not None else 's'}{SESSION_SEPARATOR}{secrets.token_hex(12)}",
            launch_token=launch_token,
            match=match,
            side=own or side,
            program=f"touchline {installed_version('touchline')}",
            source=source,
        )
        self._key = robot
        """Robot on whose key the claim is sent: one that the account has, so that the host can refuse it."""
        self._is_declared = False

    def fits(self, setup: Setup) -> bool:
        """Whether this match has the robot that the agent was started for; a claim of another one is refused."""
        side = setup.sides.get(self._claim.robot)
        return side is not None and self._claim.side in (None, side) and self._claim.match in (None, setup.match)

    def join(self, setup: Setup, patience: float) -> None:
        """Claim the robot; again for each host that the agent meets.

        Raises:
            TouchlineError: the credentials are none of a team, the host refuses, or it does not reply for `patience` s
                of wall time.
        """
        account = self._bus.account
        if account is not None and account not in (Account.CYAN, Account.MAGENTA):
            raise TouchlineError(
                f"{self._claim.robot}: these are the credentials of {account.value}; robots join with those of their "
                f"side, {Account.CYAN.value}.json or {Account.MAGENTA.value}.json"
            )
        if not self._is_declared:
            if setup.claims:
                self._bus.declare_alive(PresenceKind.SESSION, self._claim.session)
            else:  # a replay, which knows the tokens of robots only
                self._bus.declare_alive(PresenceKind.AGENT, self._claim.robot)
            self._is_declared = True
        if not self.fits(setup) and account is not None and account.side is not None:
            self._key = setup.teams[account.side].robots[0]
        if setup.claims:
            reply = self._ask(patience)
            if not reply.accepted:
                raise TouchlineError(f"{self._claim.robot}: refused by the host: {reply.reason}")

    def _ask(self, patience: float) -> AgentClaimReply:
        clock = self._bus.clock
        deadline = clock.now() + max(patience, CLAIM_REPLY_S)
        while True:
            try:
                query = self._bus.query(ROBOT_CLAIM, self._claim, timeout=CLAIM_REPLY_S, robot=self._key)
                reply: AgentClaimReply = query.result(CLAIM_REPLY_S)
            except RefusedQueryError as error:
                raise TouchlineError(f"{self._claim.robot}: refused by the host: {error}") from None
            except NoReplyError as error:
                if clock.now() >= deadline:
                    raise TouchlineError(
                        f"{self._claim.robot}: the host does not reply to the agent's claim ({error})"
                    ) from None
                clock.sleep_until(clock.now() + SLICE_S)
            else:
                return reply
