history --y probe.acceleration --by method.basis
