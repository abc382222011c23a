from __future__ import annotations

from pathlib import Path

import pytest

from reina.lab import PosableChain, posable_chains
from reina.skeleton import Rig, load_rig

RIG = Path(__file__).parents[3] / "rigs" / "trumpeter"


@pytest.fixture(scope="session")
def rig() -> Rig:
    return load_rig(RIG)


@pytest.fixture(scope="session")
def chains(rig: Rig) -> dict[str, PosableChain]:
    return {chain.name: chain for chain in posable_chains(rig)}
