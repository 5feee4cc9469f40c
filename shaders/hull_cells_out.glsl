flat out int hull_cell;
