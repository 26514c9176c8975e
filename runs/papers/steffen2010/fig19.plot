lines --x time.dt --y result.budget.l2.increment --by mesh.cells --by method.degree
