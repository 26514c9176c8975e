lines --x mesh.cells --y result.displacement.final.rms --by mesh.particles_per_cell
