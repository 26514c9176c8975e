lines --x time.dt --y result.jump.final.inf --by problem.knot
