"""The trumpet: swept tubes and turned parts, each in the instrument's own frame."""
