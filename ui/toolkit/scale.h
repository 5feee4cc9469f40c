/* How large texts and controls are on a screen. A pure function. */
#ifndef ANG_UI_SCALE_H
#define ANG_UI_SCALE_H

/* Pixels for each unit of length of the interface, of which an ordinary screen has 96 an inch: what the window system
 * says (`told`) unless that is 1, which it also says where nobody has set anything. Then by the screen itself, `pixels`
 * and `mm` across: in steps of 1/4 from 1 to 4, larger than 1 only where its pixels are half as fine again as ordinary
 * ones. Widths of less than 180 mm and more than 2 m are those of projectors and of screens that say nothing true. */
double ang_screen_scale(double told, int pixels, int mm);

#endif
