"""What the player wears: band uniform, shoes and hair, made from the body's own helper surfaces."""
