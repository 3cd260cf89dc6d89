#include "mc/files/formats/tdms_metadata.hpp"

#include <fmt/format.h>

#include <iterator>

namespace gearpod::mc {
namespace {

// Lengths that mark the raw data index of DAQmx data.
constexpr std::uint64_t kFormatChanging = 0x1269, kDigitalLine = 0x126A;
constexpr std::uint64_t kLargestSize = ~std::uint64_t{0};

// Types of DAQmx scalers, by their number.
constexpr TdmsType kScalerTypes[] = {
    TdmsType::uint8, TdmsType::int8,   TdmsType::uint16, TdmsType::int16,   TdmsType::uint32,
    TdmsType::int32, TdmsType::uint64, TdmsType::int64,  TdmsType::float32, TdmsType::float64};

}  // namespace

TdmsProperty TdmsCursor::property() {
    const auto type = static_cast<TdmsType>(number(4));
    switch (type) {
        case TdmsType::string:
            return text();
        case TdmsType::timestamp:
            need(tdms_width(type));
            at_ += tdms_width(type);
            return tdms_time(bytes_, at_ - tdms_width(type), big_endian_);
        case TdmsType::boolean:
            return static_cast<double>(number(1));
        case TdmsType::int8:
        case TdmsType::int16:
        case TdmsType::int32:
        case TdmsType::int64:
        case TdmsType::uint8:
        case TdmsType::uint16:
        case TdmsType::uint32:
        case TdmsType::uint64:
        case TdmsType::float32:
        case TdmsType::float64:
        case TdmsType::float32_with_unit:
        case TdmsType::float64_with_unit: {
            const std::uint64_t width = tdms_width(type);
            need(width);
            const double value = tdms_number(bytes_, at_, type, big_endian_);
            at_ += width;
            return value;
        }
        case TdmsType::none:
        case TdmsType::complex64:
        case TdmsType::complex128:
            break;
    }
    throw TdmsDamage{
        fmt::format("a property has the unknown type {:#x}", static_cast<std::uint32_t>(type))};
}

TdmsIndex read_tdms_index(TdmsCursor& cursor, std::uint64_t length) {
    TdmsIndex index;
    index.type = static_cast<TdmsType>(cursor.number(4));
    if (cursor.number(4) != 1) {
        throw TdmsDamage{"a channel has arrays of several dimensions"};
    }
    index.count = cursor.number(8);
    if (length == kDigitalLine) {
        throw TdmsDamage{
            "it has raw data of DAQmx digital lines, which are not supported; save the file "
            "with scaled values, or export it as CSV",
            true};
    }
    if (length == kFormatChanging) {
        index.daqmx = true;
        for (std::uint64_t left = cursor.number(4); left > 0; --left) {
            TdmsScaler& scaler = index.scalers.emplace_back();
            const std::uint64_t type = cursor.number(4);
            if (type >= std::size(kScalerTypes)) {
                throw TdmsDamage{fmt::format("its DAQmx data have the unknown type {}", type)};
            }
            scaler.type = kScalerTypes[type];
            scaler.buffer = cursor.number(4);
            scaler.offset = cursor.number(4);
            cursor.number(4);  // sample format, which the type states
            scaler.scale = static_cast<std::uint32_t>(cursor.number(4));
        }
        for (std::uint64_t left = cursor.number(4); left > 0; --left) {
            index.buffer_widths.push_back(cursor.number(4));
        }
        return index;
    }
    if (index.type == TdmsType::string) {
        index.bytes = cursor.number(8);
        return index;
    }
    const std::uint64_t width = tdms_width(index.type);
    if (width == 0) {
        throw TdmsDamage{fmt::format("a channel has the type {:#x}, which is not supported",
                                     static_cast<std::uint32_t>(index.type)),
                         true};
    }
    index.bytes = index.count > kLargestSize / width ? kLargestSize : index.count * width;
    return index;
}

std::vector<std::string> tdms_names(std::string_view path) {
    if (path.find('\0') != std::string_view::npos) {
        throw TdmsDamage{"an object has a zero byte in its path"};
    }
    std::vector<std::string> names;
    for (std::size_t at = 0; at < path.size();) {
        if (path[at] != '/') {
            throw TdmsDamage{"an object has an invalid path"};
        }
        if (++at == path.size()) {
            break;  // the path of the file itself
        }
        if (path[at] != '\'') {
            throw TdmsDamage{"an object has an invalid path"};
        }
        std::string& name = names.emplace_back();
        for (++at; at < path.size(); ++at) {
            if (path[at] == '\'' && !path.substr(at + 1).starts_with('\'')) {
                break;
            }
            at += path[at] == '\'' ? 1 : 0;
            name += path[at];
        }
        ++at;
    }
    return names;
}

}  // namespace gearpod::mc
