/* CRC-32 as in zlib, faster where the processor multiplies without carries. */
#ifndef ANG_IO_CHECKSUM_H
#define ANG_IO_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* The CRC-32 (ISO 3309, as zlib's crc32) of `length` bytes, going on from `crc`; 0 to begin. Pure, thread safe. */
uint32_t ang_checksum(uint32_t crc, const void *bytes, size_t length);

#endif
