/* What a process that decodes may still do. Private to io/sandbox/. */
#ifndef ANG_IO_SANDBOX_CONFINE_H
#define ANG_IO_SANDBOX_CONFINE_H

#include <stdbool.h>

/* Gives up for good all but memory, time and the two descriptors of protocol.h: no files, no network, no processes, no
 * privileges. A call that is not allowed ends the process with SIGSYS. False where the kernel has no such filter, or
 * where the process is watched by AddressSanitizer, whose reports need more. */
bool ang_confine(void);

#endif
