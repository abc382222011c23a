"""How the player holds the instrument: a least-squares search over arms, hands and fingers."""
