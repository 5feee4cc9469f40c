/* The bar of menus. */
#ifndef ANG_UI_MENUS_H
#define ANG_UI_MENUS_H

typedef struct ang_viewer ang_viewer;

double ang_menus(ang_viewer *viewer); /* the bar's height */

#endif
