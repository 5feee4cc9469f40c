/* GDCM's codecs for compressed pixel data. Only the compressed stream of one frame goes in: headers are parsed by
 * parse.c, because GDCM's own parser ends the process on damaged ones. */
extern "C" {
#include "io/dicom/codec.h"
}

#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmJPEG2000Codec.h>
#include <gdcmJPEGCodec.h>
#include <gdcmJPEGLSCodec.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <cstring>
#include <exception>
#include <mutex>
#include <new>

namespace {

/* GDCM chooses among its JPEG libraries by BitsAllocated, so that a 12-bit stream is first tried with the 16-bit one,
 * which complains on stderr. The stream's own precision is known here. */
class precise_jpeg : public gdcm::JPEGCodec {
  public:
    void set_precision(int bits) { SetBitSample(bits <= 8 ? 8 : bits <= 12 ? 12 : 16); }
};

bool is_jpeg(gdcm::TransferSyntax::TSType type) {
    switch (type) {
    case gdcm::TransferSyntax::JPEGBaselineProcess1:
    case gdcm::TransferSyntax::JPEGExtendedProcess2_4:
    case gdcm::TransferSyntax::JPEGExtendedProcess3_5:
    case gdcm::TransferSyntax::JPEGSpectralSelectionProcess6_8:
    case gdcm::TransferSyntax::JPEGFullProgressionProcess10_12:
    case gdcm::TransferSyntax::JPEGLosslessProcess14:
    case gdcm::TransferSyntax::JPEGLosslessProcess14_1:
        return true;
    default:
        return false;
    }
}

bool decode_with(gdcm::ImageCodec &codec, const gdcm::DataElement &element, const gdcm::Image &image, void *pixels,
                 size_t size) {
    codec.SetNumberOfDimensions(2);
    codec.SetDimensions(image.GetDimensions());
    codec.SetPlanarConfiguration(0);
    codec.SetPhotometricInterpretation(image.GetPhotometricInterpretation());
    codec.SetPixelFormat(image.GetPixelFormat());
    gdcm::DataElement out;
    if (!codec.Decode(element, out)) return false;
    const gdcm::ByteValue *value = out.GetByteValue();
    if (!value || static_cast<size_t>(value->GetLength()) < size) return false;
    std::memcpy(pixels, value->GetPointer(), size);
    return true;
}

/* The codec is chosen here: GDCM would try one after the other. */
bool decode_as(gdcm::TransferSyntax::TSType type, const gdcm::DataElement &element, const gdcm::Image &image, int bits,
               void *pixels, size_t size) {
    if (is_jpeg(type)) {
        precise_jpeg codec;
        codec.set_precision(bits);
        return decode_with(codec, element, image, pixels, size);
    }
    if (type == gdcm::TransferSyntax::JPEGLSLossless || type == gdcm::TransferSyntax::JPEGLSNearLossless) {
        gdcm::JPEGLSCodec codec;
        return decode_with(codec, element, image, pixels, size);
    }
    /* Frames are decoded side by side: threads within one, GDCM's default, would be in each other's way. */
    gdcm::JPEG2000Codec codec;
    codec.SetNumberOfThreadsForDecompression(0);
    return codec.CanDecode(type) && decode_with(codec, element, image, pixels, size);
}

} // namespace

static bool decode(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                   ang_error *err) {
    /* GDCM complains to stderr by default: errors are returned here, and said once by the program. */
    static std::once_flag quiet;
    std::call_once(quiet, [] {
        gdcm::Trace::DebugOff();
        gdcm::Trace::WarningOff();
        gdcm::Trace::ErrorOff();
    });
    gdcm::TransferSyntax::TSType type = gdcm::TransferSyntax::GetTSType(frame->transfer_syntax);
    gdcm::TransferSyntax syntax(type);
    if (type == gdcm::TransferSyntax::TS_END || !syntax.IsEncapsulated())
        return ang_fail(err, ANG_INPUT, "transfer syntax %s is not supported", frame->transfer_syntax);

    gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
    gdcm::Fragment fragment;
    fragment.SetByteValue(reinterpret_cast<const char *>(stream), static_cast<uint32_t>(length));
    fragments->AddFragment(fragment);
    gdcm::DataElement element(gdcm::Tag(0x7FE0, 0x0010), 0, gdcm::VR::OB);
    element.SetValue(*fragments);

    unsigned short allocated = frame->bits <= 8 ? 8 : 16, bits = static_cast<unsigned short>(frame->bits);
    gdcm::Image image;
    image.SetNumberOfDimensions(2);
    image.SetDimension(0, static_cast<unsigned int>(frame->columns));
    image.SetDimension(1, static_cast<unsigned int>(frame->rows));
    image.SetPixelFormat(
        gdcm::PixelFormat(1, allocated, bits, static_cast<unsigned short>(bits - 1), frame->is_signed ? 1 : 0));
    image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image.SetTransferSyntax(syntax);
    image.SetDataElement(element);
    if (image.GetBufferLength() != size)
        return ang_fail(err, ANG_INPUT, "the decoder would give %lu bytes, not %zu", image.GetBufferLength(), size);
    if (!decode_as(type, element, image, frame->bits, pixels, size))
        return ang_fail(err, ANG_INPUT, "its pixels cannot be decoded (transfer syntax %s)", frame->transfer_syntax);
    return true;
}

static bool decode_safely(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                          ang_error *err) {
    try {
        return decode(stream, length, frame, pixels, size, err);
    } catch (const std::bad_alloc &) {
        return ang_fail(err, ANG_LIMIT, "decoding its pixels takes more memory than there is for it");
    } catch (const std::exception &) {
        return ang_fail(err, ANG_INPUT, "its pixels cannot be decoded (transfer syntax %s)", frame->transfer_syntax);
    }
}

extern "C" __attribute__((visibility("default"))) ang_codec_function *const ang_gdcm_decode = decode_safely;
