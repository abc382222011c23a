"""The drum kit and its sticks: measures, pieces, and the rigs that they make."""
