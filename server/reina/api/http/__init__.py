"""What every route shares: guards, bodies, conditions, ranges, problem details."""
