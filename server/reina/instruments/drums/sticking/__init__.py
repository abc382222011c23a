"""Which hand strikes: habits, figures and the way through a part that costs the hands least."""
