// Writes a small picture in every compression of GDCM as bare streams, to begin fuzzing with: usage: streams DIR.
// Names are the end of the transfer syntax and the bits: 4.90-12.
#include <gdcmImage.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmSequenceOfFragments.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

static bool write_stream(const std::string &path, gdcm::TransferSyntax::TSType type, int bits) {
    unsigned int side = 16;
    unsigned short allocated = bits <= 8 ? 8 : 16;
    std::vector<char> pixels(size_t(side) * side * allocated / 8);
    for (size_t i = 0; i < size_t(side) * side; i++) {
        unsigned int value = unsigned(i * i + 3 * i) & ((1U << bits) - 1);
        if (allocated == 8) {
            pixels[i] = char(value);
        } else {
            pixels[2 * i] = char(value);
            pixels[2 * i + 1] = char(value >> 8);
        }
    }
    gdcm::SmartPointer<gdcm::Image> image = new gdcm::Image;
    image->SetNumberOfDimensions(2);
    image->SetDimension(0, side);
    image->SetDimension(1, side);
    image->SetPixelFormat(gdcm::PixelFormat(1, allocated, (unsigned short)bits, (unsigned short)(bits - 1), 0));
    image->SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image->SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    gdcm::DataElement element(gdcm::Tag(0x7FE0, 0x0010));
    element.SetByteValue(pixels.data(), uint32_t(pixels.size()));
    image->SetDataElement(element);
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(type);
    change.SetInput(*image);
    if (!change.Change()) return false;
    const gdcm::SequenceOfFragments *fragments = change.GetOutput().GetDataElement().GetSequenceOfFragments();
    if (!fragments || fragments->GetNumberOfFragments() != 1) return false;
    const gdcm::ByteValue *value = fragments->GetFragment(0).GetByteValue();
    std::ofstream out(path, std::ios::binary);
    return bool(out.write(value->GetPointer(), value->GetLength()));
}

int main(int count, char **arguments) {
    if (count != 2) return 2;
    static const struct {
        gdcm::TransferSyntax::TSType type;
        const char *ending;
        int bits;
    } kinds[] = {{gdcm::TransferSyntax::JPEGBaselineProcess1, "4.50", 8},
                 {gdcm::TransferSyntax::JPEGExtendedProcess2_4, "4.51", 12},
                 {gdcm::TransferSyntax::JPEGLosslessProcess14, "4.57", 16},
                 {gdcm::TransferSyntax::JPEGLosslessProcess14_1, "4.70", 12},
                 {gdcm::TransferSyntax::JPEGLosslessProcess14_1, "4.70", 8},
                 {gdcm::TransferSyntax::JPEGLSLossless, "4.80", 12},
                 {gdcm::TransferSyntax::JPEGLSNearLossless, "4.81", 8},
                 {gdcm::TransferSyntax::JPEG2000Lossless, "4.90", 16},
                 {gdcm::TransferSyntax::JPEG2000Lossless, "4.90", 8},
                 {gdcm::TransferSyntax::JPEG2000, "4.91", 12}};
    for (const auto &kind : kinds) {
        std::string name = std::string(kind.ending) + "-" + std::to_string(kind.bits);
        if (!write_stream(std::string(arguments[1]) + "/" + name, kind.type, kind.bits))
            std::fprintf(stderr, "%s cannot be made\n", name.c_str());
    }
    return 0;
}
