/* The order in which people expect the names of files. */
#ifndef ANG_BASE_NAME_ORDER_H
#define ANG_BASE_NAME_ORDER_H

/* By letters without regard to case, runs of digits by their value: "IM9" before "im10". As strcmp. */
int ang_name_compare(const char *a, const char *b);

#endif
