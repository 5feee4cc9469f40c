#include "io/image/oiio_grey.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

using namespace OIIO;

namespace {

struct grey_file {
    std::unique_ptr<Filesystem::IOMemReader> bytes; /* outlives `input` */
    std::unique_ptr<ImageInput> input;
    std::string label;
    ang_grey_form form;
    TypeDesc format;
    int bits; /* of a sample where the file has fewer than its type; else 0 */
};

std::string base_name(const char *path) {
    std::string name(path);
    return name.substr(name.find_last_of('/') + 1);
}

bool sample_of(const TypeDesc &format, ang_sample *sample, TypeDesc *read_as) {
    *read_as = format;
    switch (format.basetype) {
    case TypeDesc::UINT8:
        *sample = ANG_SAMPLE_U8;
        return true;
    case TypeDesc::INT8:
        *sample = ANG_SAMPLE_I8;
        return true;
    case TypeDesc::UINT16:
        *sample = ANG_SAMPLE_U16;
        return true;
    case TypeDesc::INT16:
        *sample = ANG_SAMPLE_I16;
        return true;
    case TypeDesc::UINT32:
        *sample = ANG_SAMPLE_U32;
        return true;
    case TypeDesc::INT32:
        *sample = ANG_SAMPLE_I32;
        return true;
    case TypeDesc::HALF:
    case TypeDesc::FLOAT:
        *sample = ANG_SAMPLE_F32;
        *read_as = TypeDesc::FLOAT;
        return true;
    case TypeDesc::DOUBLE:
        *sample = ANG_SAMPLE_F64;
        return true;
    default:
        return false;
    }
}

bool fail_reading(const std::string &label, std::string reason, ang_error *err) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return ang_fail(err, ANG_INPUT, "%s: cannot be read as a picture (%s)", label.c_str(), reason.c_str());
}

bool take_form(grey_file &file, const ImageSpec &spec, ang_error *err) {
    if (spec.nchannels != 1)
        return ang_fail(err, ANG_INPUT, "%s: is in colour or has alpha (%d channels): a stack is of grey pictures",
                        file.label.c_str(), spec.nchannels);
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1)
        return ang_fail(err, ANG_INPUT, "%s: is no picture in one layer", file.label.c_str());
    int bits = spec.get_int_attribute("oiio:BitsPerSample", 0);
    file.bits = bits > 0 && bits < int(spec.format.basesize()) * 8 ? bits : 0;
    file.form = {spec.width, spec.height, 1, ANG_SAMPLE_U8};
    return sample_of(spec.format, &file.form.type, &file.format) ||
           ang_fail(err, ANG_INPUT, "%s: its numbers are of a type that is not read (%s)", file.label.c_str(),
                    spec.format.c_str());
}

/* "png" or "tiff" by the first byte, whatever the name; NULL where it is neither. Left to itself the library would try
 * one format after the other of all that it knows. */
const char *format_of(const char *path, const void *bytes, size_t size) {
    char first = 0;
    bool there = bytes ? size > 0 : Filesystem::read_bytes(path, &first, 1) == 1;
    if (there && bytes) std::memcpy(&first, bytes, 1);
    return !there ? nullptr : first == '\x89' ? "png" : first == 'I' || first == 'M' ? "tiff" : nullptr;
}

/* The library stretches samples of 1 to 7 and 9 to 15 bits over the whole of their type. */
template <typename number> void unstretch(number *samples, size_t count, int bits) {
    unsigned whole = (1U << (8 * sizeof(number))) - 1, most = (1U << bits) - 1;
    for (size_t i = 0; i < count; i++) samples[i] = number((uint64_t(samples[i]) * most + whole / 2) / whole);
}

} // namespace

void *ang_grey_open(const char *path, const void *bytes, size_t size, ang_grey_form *form, ang_error *err) {
    try {
        auto file = std::make_unique<grey_file>();
        ImageSpec wish;
        file->label = base_name(path);
        wish.attribute("oiio:UnassociatedAlpha", 1);
        if (bytes) {
            file->bytes = std::make_unique<Filesystem::IOMemReader>(const_cast<void *>(bytes), size);
            Filesystem::IOProxy *proxy = file->bytes.get();
            wish.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
        }
        const char *format = format_of(path, bytes, size);
        ImageSpec spec;
        if (format) file->input = ImageInput::create(format);
        if (!file->input || !file->input->open(path, spec, wish)) {
            fail_reading(file->label,
                         !format       ? "no PNG or TIFF"
                         : file->input ? file->input->geterror()
                                       : geterror(),
                         err);
            return nullptr;
        }
        if (!take_form(*file, file->input->spec(), err)) return nullptr;
        ang_grey_form first = file->form;
        while (file->input->seek_subimage(first.pages, 0)) {
            if (!take_form(*file, file->input->spec(), err)) return nullptr;
            if (file->form.width != first.width || file->form.height != first.height || file->form.type != first.type) {
                ang_fail(err, ANG_INPUT, "%s: its page %d is %d x %d, unlike the first, %d x %d, or of another type",
                         file->label.c_str(), first.pages + 1, file->form.width, file->form.height, first.width,
                         first.height);
                return nullptr;
            }
            first.pages++;
        }
        file->input->geterror(); /* there is no further page: no error */
        file->form = *form = first;
        return file.release();
    } catch (const std::bad_alloc &) {
        ang_fail(err, ANG_LIMIT, "%s: no memory for the picture", path);
    } catch (const std::exception &exception) {
        ang_fail(err, ANG_INPUT, "%s: cannot be read (%s)", path, exception.what());
    }
    return nullptr;
}

bool ang_grey_read(void *handle, int page, void *out, ang_error *err) {
    auto *file = static_cast<grey_file *>(handle);
    try {
        if (!file->input->read_image(page, 0, 0, 1, file->format, out))
            return fail_reading(file->label, file->input->geterror(), err);
        size_t count = size_t(file->form.width) * size_t(file->form.height);
        if (file->bits > 0 && file->form.type == ANG_SAMPLE_U8)
            unstretch(static_cast<unsigned char *>(out), count, file->bits);
        if (file->bits > 0 && file->form.type == ANG_SAMPLE_U16)
            unstretch(static_cast<unsigned short *>(out), count, file->bits);
        return true;
    } catch (const std::bad_alloc &) {
        return ang_fail(err, ANG_LIMIT, "%s: no memory for the picture", file->label.c_str());
    } catch (const std::exception &exception) {
        return ang_fail(err, ANG_INPUT, "%s: cannot be read (%s)", file->label.c_str(), exception.what());
    }
}

void ang_grey_close(void *handle) { delete static_cast<grey_file *>(handle); }

void ang_grey_settle() {
    /* Black, one pixel. */
    static const unsigned char picture[] = {
        0x89, 'P',  'N',  'G',  '\r', '\n', 0x1A, '\n', 0,    0,    0,    13,  'I',  'H',  'D',  'R',  0,
        0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,    0,   0x3A, 0x7E, 0x9B, 0x55, 0,
        0,    0,    10,   'I',  'D',  'A',  'T',  0x78, 0x9C, 0x63, 0x60, 0,   0,    0,    2,    0,    1,
        0x48, 0xAF, 0xA4, 0x71, 0,    0,    0,    0,    'I',  'E',  'N',  'D', 0xAE, 0x42, 0x60, 0x82};
    attribute("threads", 1);
    attribute("exr_threads", -1);
    ang_grey_form form;
    unsigned char pixel;
    void *handle = ang_grey_open("settle.png", picture, sizeof picture, &form, nullptr);
    if (!handle) return;
    ang_grey_read(handle, 0, &pixel, nullptr);
    ang_grey_close(handle);
}
