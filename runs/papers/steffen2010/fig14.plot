lines --x mesh.cells --y result.budget.l2.projected --by method.degree
