lines --x time.end --y result.displacement.final.inf
