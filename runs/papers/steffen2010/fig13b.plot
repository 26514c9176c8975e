lines --x mesh.cells --y result.displacement.final.rms
