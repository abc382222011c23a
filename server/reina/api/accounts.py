"""Who may upload, as a file says it: one password for all, or a line for each person."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.system.passwords import UNMATCHED, hash_password, is_password_hash, password_matches

if TYPE_CHECKING:
    from pathlib import Path

SHORTEST_PASSWORD, LONGEST_PASSWORD = 8, 200
MOST_BYTES = 1_000_000
_NAME = re.compile(r"[\w.@+-]{1,64}")


def is_name(text: str) -> bool:
    """Whether a person can be called so."""
    return _NAME.fullmatch(text) is not None


@dataclass(frozen=True)
class Account:
    """Whose password it is, and what is kept of it.

    Attributes:
        name: The person; None for everybody who knows the one password.
        stored: The password's hash.
        line: As it stands in the file: who was let in by it stays so for as long as it does.
    """

    name: str | None
    stored: str
    line: str


class Accounts:
    """All passwords that let somebody upload.

    Args:
        accounts: Each account; either the one of everybody, or one of each person.
    """

    def __init__(self, accounts: list[Account]) -> None:
        self._by_name = {account.name: account for account in accounts}
        self.have_names = None not in self._by_name

    @classmethod
    def read(cls, path: Path) -> Accounts:
        """Read the file: takes a moment for a password that stands in it as it is.

        Raises:
            InputError: It cannot be read, or says nobody.
        """
        try:
            text = path.read_bytes()[:MOST_BYTES].decode()
        except (OSError, ValueError) as error:
            raise InputError(f"the passwords in {path} cannot be read: {error}") from error
        lines = [line.strip() for line in text.splitlines()]
        lines = [line for line in lines if line and not line.startswith("#")]
        named = [_named(line) for line in lines]
        if lines and all(account is not None for account in named):
            accounts = [account for account in named if account is not None]
            names = [account.name for account in accounts]
            if len(set(names)) < len(names):
                raise InputError(f"{path} has a name twice; each person has one line")
            return cls(accounts)
        if len(lines) != 1:
            raise InputError(
                f"{path} is to hold one password, or lines `name:scrypt$...` that `reina password --name` "
                f"makes; it has {len(lines)} lines, and not all of them are such"
            )
        [line] = lines
        if is_password_hash(line):
            return cls([Account(None, line, line)])
        if not SHORTEST_PASSWORD <= len(line) <= LONGEST_PASSWORD:
            raise InputError(
                f"the password in {path} is to have {SHORTEST_PASSWORD} to {LONGEST_PASSWORD} characters, "
                f"not {len(line)}"
            )
        return cls([Account(None, hash_password(line), line)])

    def of(self, name: str | None) -> Account | None:
        """The account of a person, or of everybody; None where there is none."""
        return self._by_name.get(name)

    def admitted(self, name: str | None, password: str) -> Account | None:
        """Whose password it is, if it is right; takes a tenth of a second, whether it is or not.

        Args:
            name: Whose it is said to be; not looked at where all have one.
            password: The password.
        """
        account = self.of(name if self.have_names else None)
        # What is tried for a name that nobody has takes as long as for one that somebody has.
        matches = password_matches(UNMATCHED if account is None else account.stored, password)
        return account if matches else None


def _named(line: str) -> Account | None:
    name, colon, stored = line.partition(":")
    return Account(name, stored, line) if colon and is_name(name) and is_password_hash(stored) else None
