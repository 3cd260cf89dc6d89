// Values and properties in TDMS files (tdms_file.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mc/files/formats/byte_numbers.hpp"

namespace gearpod::mc {

// Types of values; the numbers are those of the format.
enum class TdmsType : std::uint32_t {
    none = 0,
    int8 = 1,
    int16 = 2,
    int32 = 3,
    int64 = 4,
    uint8 = 5,
    uint16 = 6,
    uint32 = 7,
    uint64 = 8,
    float32 = 9,
    float64 = 10,
    float32_with_unit = 0x19,
    float64_with_unit = 0x1A,
    string = 0x20,
    boolean = 0x21,
    timestamp = 0x44,
    complex64 = 0x08000C,
    complex128 = 0x10000D,
};

// Point in time: seconds since 1904-01-01 00:00 UTC and 2^-64 of a second.
struct TdmsTime {
    std::int64_t seconds = 0;
    std::uint64_t fraction = 0;

    // Seconds from `earlier` to this time.
    double since(const TdmsTime& earlier) const;
};

using TdmsProperty = std::variant<double, std::string, TdmsTime>;
using TdmsProperties = std::map<std::string, TdmsProperty>;

// Bytes of a value in the file; 0 if values have no fixed size.
std::uint64_t tdms_width(TdmsType type);

// Integer, floating-point or boolean value.
double tdms_number(std::string_view bytes, std::size_t at, TdmsType type, bool big_endian);

TdmsTime tdms_time(std::string_view bytes, std::size_t at, bool big_endian);

// True for integers, floating-point numbers and booleans.
bool is_tdms_number(TdmsType type);

// Metadata of a segment of a TDMS file (tdms_file.hpp). All functions throw TdmsDamage.

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

// Channels of a TDMS file of LabVIEW. Source: National Instruments, "TDMS File Format Internal
// Structure".

// Equally spaced values in the file.
struct TdmsBlock {
    std::uint64_t first = 0, stride = 0, count = 0;  // bytes, bytes, values
    TdmsType type = TdmsType::none;
    bool big_endian = false;
};

// Raw values of a channel. DAQmx channels may have several, each with the number of a scale; other
// channels have one.
struct TdmsRaw {
    std::uint32_t scale = 0;
    std::vector<TdmsBlock> blocks;
};

struct TdmsChannel {
    std::string path, group, name;
    TdmsType type = TdmsType::none;
    std::vector<TdmsRaw> raw;
    TdmsProperties properties;
    bool daqmx = false;
};

struct TdmsFile {
    bool closed = true;                 // false if the last segment may lack values
    std::vector<TdmsChannel> channels;  // in the order of the file
    TdmsProperties properties;
    std::map<std::string, TdmsProperties> groups;
};

// Throws SignalError (signal_error.hpp) if the file is damaged, truncated or not a TDMS file.
TdmsFile read_tdms(const std::string& path);

}  // namespace gearpod::mc
