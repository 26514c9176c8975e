history --y probe.displacement_error
