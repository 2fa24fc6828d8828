"""The tokens: each gives the rights of one role. They are kept in a file, so that they outlast the process."""

import hmac
import json
import secrets
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Self

from coach_gateway.access.roles import TokenRole
from runtime.access.private_file import check_private
from runtime.process.whole_file import written_whole
from schemas.errors import TouchlineError

_MIN_LENGTH = 8
"""Characters of a token, at least."""
_RANDOM_BYTES = 16
UNKNOWN_TOKEN = "unknown token; open the page with the address that was given out"
"""The reply to a token that stands for no role."""


@dataclass(frozen=True, slots=True)
class Tokens:
    """One token for each role except the spectator, who has none."""

    referee: str
    cyan: str
    magenta: str

    @classmethod
    def random(cls) -> Self:
        """New ones, of 128 bits each."""
        return cls(*(secrets.token_urlsafe(_RANDOM_BYTES) for _ in fields(cls)))

    def role_of(self, token: str) -> TokenRole | None:
        """The role of a token: spectator for an empty token, None for an unknown one.

        Takes the same time for every token of one length.
        """
        if not token:
            return TokenRole.SPECTATOR
        given, found = token.encode(errors="replace"), None
        for role in (TokenRole.REFEREE, TokenRole.CYAN, TokenRole.MAGENTA):
            if hmac.compare_digest(given, self.of(role).encode()):
                found = role
        return found

    def lines(self) -> list[str]:
        """Each role and its token, for the operator."""
        return [f"{field.name}'s token: {getattr(self, field.name)}" for field in fields(self)]

    def of(self, role: TokenRole) -> str:
        """The token of a role."""
        return "" if role is TokenRole.SPECTATOR else str(getattr(self, role.value))


def page_address(origin: str, token: str) -> str:
    """The page's address with a token, which stays in the browser: a browser does not send what follows #."""
    return f"{origin}/#token={token}" if token else f"{origin}/"


def tokens_of(path: Path | None) -> Tokens:
    """The tokens of a file; a missing file is created, readable by its owner alone.

    Without a file they are new, and last as long as the process.

    Raises:
        TouchlineError: others may read the file, or its content is invalid.
    """
    if path is None:
        return Tokens.random()
    try:
        return _make(path)
    except FileExistsError:
        return _read(path)
    except OSError as error:
        raise TouchlineError(f"--tokens {path} cannot be written ({error.strerror}); name another file") from None


def _make(path: Path) -> Tokens:
    """Create the file atomically: a bridge and a page may start at the same time."""
    tokens = Tokens.random()
    text = json.dumps({field.name: getattr(tokens, field.name) for field in fields(Tokens)}, indent=2)
    with written_whole(path, private=True, replace=False) as draft:
        draft.write_text(text + "\n", "utf-8")
    return tokens


def _read(path: Path) -> Tokens:
    try:
        with path.open("rb") as file:
            check_private("--tokens", path, file)
            content = json.loads(file.read())
    except OSError as error:
        raise TouchlineError(f"--tokens {path} cannot be read ({error.strerror}); name another file") from None
    except ValueError:
        raise TouchlineError(f"--tokens {path} is not JSON; delete it, and it is created again") from None
    names = [field.name for field in fields(Tokens)]
    given = [content.get(name) for name in names] if isinstance(content, dict) else []
    tokens = [token for token in given if isinstance(token, str) and len(token) >= _MIN_LENGTH]
    if len(set(tokens)) != len(names):
        raise TouchlineError(
            f"--tokens {path}: {', '.join(names)} need a token each, all different, {_MIN_LENGTH} characters or longer"
        )
    return Tokens(*tokens)
