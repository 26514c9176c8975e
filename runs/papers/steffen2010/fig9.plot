lines --x time.dt --y result.displacement.final.inf --by problem.particle_width
