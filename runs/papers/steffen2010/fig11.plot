history --y probe.displacement_error
history --y probe.jump
