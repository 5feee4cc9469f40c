/* Pages of grey for stacks: see ang_oiio_grey_open. Private to the OpenImageIO module. */
#ifndef ANG_IO_IMAGE_OIIO_GREY_HPP
#define ANG_IO_IMAGE_OIIO_GREY_HPP

extern "C" {
#include "io/image/encode.h"
}

void *ang_grey_open(const char *path, const void *bytes, size_t size, ang_grey_form *form, ang_error *err);
bool ang_grey_read(void *handle, int page, void *out, ang_error *err);
void ang_grey_close(void *handle);
void ang_grey_settle(void);

#endif
