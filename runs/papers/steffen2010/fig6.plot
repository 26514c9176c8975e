history --y jump.step
