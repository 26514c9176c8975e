lines --x time.dt --y result.budget.l2.velocity --by method.degree
