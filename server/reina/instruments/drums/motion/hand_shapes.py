"""What a hand does with its stick beside moving it, and how far along it is in that."""

from typing import Final

HAND_SHAPES: Final = ("play", "cross_stick", "choke", "twirl")
"""By their names in a player's hold: fingers open and close with the stick; the hand lies on a head; it takes
a cymbal's edge; the stick runs round a finger."""

PLAY, CROSS_STICK, CHOKE, TWIRL = range(len(HAND_SHAPES))

OPEN_RAD: Final = 0.436
"""How far the stick has turned in the hand where the fingers are wholly open."""

JAWS_SHARE: Final = 0.55
"""So far along its grip a hand is open before a cymbal's edge."""
