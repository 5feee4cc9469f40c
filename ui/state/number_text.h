/* With how many decimals numbers are shown. Pure functions. */
#ifndef ANG_UI_NUMBER_TEXT_H
#define ANG_UI_NUMBER_TEXT_H

/* As many decimals as a number has that was typed, of at most 6; where it has more, as one from a drag has, those that
 * tell values `resolution` (> 0) apart, at least one. */
int ang_number_decimals(double value, double resolution);
/* The same of a share in per cent: two digits of small ones. */
int ang_percent_decimals(double percent);

#endif
