/* What this machine is, for reports. */
#ifndef ANG_IO_MACHINE_H
#define ANG_IO_MACHINE_H

#include <stddef.h>
#include <stdint.h>

/* The processor's name as the system gives it, into `name` of `size` bytes; "unknown" where it does not say. */
void ang_machine_processor(char *name, size_t size);

/* How many processes wanted a processor on average over the last minute; NaN where the system does not say. */
double ang_machine_load(void);

/* A checksum of the running program's file, which a new build changes; 0 where it cannot be read. */
uint32_t ang_machine_program_checksum(void);

#endif
