// Metadata of a segment of a TDMS file (tdms_file.hpp). All functions throw TdmsDamage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/files/formats/tdms_values.hpp"

namespace gearpod::mc {

// Special lengths of a raw data index: no data in this segment, or the same index as before.
inline constexpr std::uint64_t kTdmsNoData = 0xFFFFFFFF, kTdmsAsBefore = 0;

// Problem with a file, without its name.
struct TdmsDamage {
    std::string why;
    bool unsupported = false;  // true if the file may be undamaged
};

// Reads the metadata of a segment.
class TdmsCursor {
  public:
    TdmsCursor(std::string_view bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

    std::uint64_t number(std::size_t width) {
        need(width);
        const std::uint64_t value = unsigned_at(bytes_, at_, width, big_endian_);
        at_ += width;
        return value;
    }
    std::string text() {
        const std::uint64_t length = number(4);
        need(length);
        const std::string value(bytes_.substr(at_, length));
        at_ += length;
        return value;
    }
    TdmsProperty property();

  private:
    void need(std::uint64_t count) const {
        if (count > bytes_.size() - at_) {
            throw TdmsDamage{"its metadata end too early"};
        }
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    bool big_endian_;
};

struct TdmsScaler {
    TdmsType type = TdmsType::none;
    std::uint64_t buffer = 0, offset = 0;
    std::uint32_t scale = 0;
};

// Raw data index: the data of an object in each chunk of a segment.
struct TdmsIndex {
    TdmsType type = TdmsType::none;
    std::uint64_t count = 0, bytes = 0;  // of a chunk
    bool daqmx = false;
    std::vector<TdmsScaler> scalers;
    std::vector<std::uint64_t> buffer_widths;
};

// Index of the given length, which is read already.
TdmsIndex read_tdms_index(TdmsCursor& cursor, std::uint64_t length);

// Names in a path such as /'group'/'channel'; a quote in a name is doubled.
std::vector<std::string> tdms_names(std::string_view path);

}  // namespace gearpod::mc
