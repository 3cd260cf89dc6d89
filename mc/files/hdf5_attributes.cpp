#include "mc/files/hdf5_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/input/parsed_number.hpp"

namespace gearpod::mc {
namespace {

constexpr hssize_t kMostAttributeValues = 1000;

// Text without padding: zeros, or blanks in files of Fortran programs.
std::string unpadded(const char* text, std::size_t size) {
    std::string_view view(text, size);
    view = view.substr(0, view.find('\0'));
    const std::size_t last = view.find_last_not_of(' ');
    return std::string(view.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

std::vector<std::string> attribute_texts(hid_t attribute, hid_t stored, std::size_t count) {
    std::vector<std::string> texts;
    const Hdf5Handle memory(H5Tcopy(stored), H5Tclose, "text");
    if (H5Tis_variable_str(stored) > 0) {
        const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "text");
        std::vector<char*> pointers(count, nullptr);
        check(H5Aread(attribute, memory.get(), pointers.data()), "text");
        for (const char* pointer : pointers) {
            texts.emplace_back(pointer == nullptr ? "" : pointer);
        }
        H5Dvlen_reclaim(memory.get(), space.get(), H5P_DEFAULT, pointers.data());
        return texts;
    }
    constexpr std::size_t kLongestText = 1 << 16;
    const std::size_t size = H5Tget_size(stored);
    if (size == 0 || size > kLongestText) {
        return {};
    }
    std::vector<char> bytes(size * count, '\0');
    check(H5Aread(attribute, memory.get(), bytes.data()), "text");
    for (std::size_t i = 0; i < count; ++i) {
        texts.push_back(unpadded(bytes.data() + i * size, size));
    }
    return texts;
}

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t*, void* to) {
    try {
        Hdf5Attribute read{name, {}, {}};
        const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
        const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, name);
        const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, name);
        const hssize_t count = H5Sget_simple_extent_npoints(space.get());
        const H5T_class_t kind = H5Tget_class(type.get());
        if (count > 0 && count <= kMostAttributeValues) {
            const auto values = static_cast<std::size_t>(count);
            if (kind == H5T_STRING) {
                read.texts = attribute_texts(attribute.get(), type.get(), values);
            } else if (kind == H5T_FLOAT || kind == H5T_INTEGER) {
                read.numbers.resize(values);
                check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, read.numbers.data()), name);
            }
        }
        static_cast<std::vector<Hdf5Attribute>*>(to)->push_back(std::move(read));
        return 0;
    } catch (const std::exception&) {
        return -1;
    }
}

// Beginnings of other kinds of files that check_file_content() lets pass.
struct FileKind {
    std::string_view begin;
    const char* name;
};
using namespace std::string_view_literals;
constexpr FileKind kFileKinds[] = {
    {"RIFF"sv, "a WAV or other RIFF file"},
    {"<"sv, "an HTML or XML text"},
    {"\x00\x00\x00\x00\x00\x00\x00\x00"sv,
     "without HDF5 signature: it begins with zeros, as if the program that wrote it did not close "
     "it"},
};

}  // namespace

std::optional<double> Hdf5Attribute::number() const {
    if (numbers.size() == 1) {
        return numbers.front();
    }
    return texts.size() == 1 ? parsed_number<double>(texts.front()) : std::nullopt;
}

std::vector<Hdf5Attribute> attributes_of(hid_t object) {
    std::vector<Hdf5Attribute> all;
    hsize_t at = 0;
    check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, &at, read_attribute, &all), "attributes");
    return all;
}

// Source of the offsets: HDF5 File Format Specification 3.0, section II.A (superblock).
std::string hdf5_open_problem(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error || !file) {
        return "cannot be read";
    }
    if (size == 0) {
        return "is empty";
    }
    constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n"sv;
    std::array<char, 64> bytes{};
    for (std::uint64_t at = 0; at < size; at = at == 0 ? 512 : 2 * at) {
        bytes.fill('\0');
        file.clear();
        file.seekg(static_cast<std::streamoff>(at));
        file.read(bytes.data(), bytes.size());
        const std::string_view head(bytes.data(), bytes.size());
        if (!head.starts_with(kSignature)) {
            if (at == 0) {
                const auto kind = std::ranges::find_if(
                    kFileKinds, [&](const FileKind& one) { return head.starts_with(one.begin); });
                if (kind != std::end(kFileKinds)) {
                    return fmt::format("is {}", kind->name);
                }
            }
            continue;
        }
        const auto* const raw = reinterpret_cast<const unsigned char*>(bytes.data());
        const unsigned version = raw[8];
        const bool first_form = version < 2;
        if (!first_form && (raw[11] & 5U) != 0) {
            return fmt::format(
                "is open in another program, or the program that wrote it did not close it; if no "
                "program has it open, repair a copy with: h5clear -s {}",
                path);
        }
        if (raw[first_form ? 13 : 9] != 8) {
            return "";
        }
        const std::size_t at_end = first_form ? (version == 1 ? 44 : 40) : 28;
        const std::uint64_t end = unsigned_at(head, at_end, 8);
        if (end > size) {
            return fmt::format(
                "is truncated ({} of {} bytes), or the program that wrote it did not close it; "
                "copy "
                "or write it again",
                size, end);
        }
        return "is damaged, or the program that wrote it did not close it; copy or write it again";
    }
    return "is not an HDF5 file, or is damaged: it has no HDF5 signature";
}

}  // namespace gearpod::mc
