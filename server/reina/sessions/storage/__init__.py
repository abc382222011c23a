"""Where sessions are kept: records in a database, large files by their content."""
