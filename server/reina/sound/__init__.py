"""The sound of a session: a score rendered, in a process of its own."""
