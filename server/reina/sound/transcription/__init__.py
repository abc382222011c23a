"""The notes of a recording alone, of one line: a score of what is heard in it."""
