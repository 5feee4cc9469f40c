/* A steady clock for durations. */
#ifndef ANG_BASE_CLOCK_H
#define ANG_BASE_CLOCK_H

/* Milliseconds since an arbitrary start; never runs backwards. Thread safe. */
double ang_now_ms(void);

#endif
