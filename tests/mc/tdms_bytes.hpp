// TDMS files written from the format's specification.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/mc/recording_bytes.hpp"

namespace gearpod::test {

// Bits of the table of contents of a segment.
enum TdmsContents : unsigned {
    kTdmsMeta = 2,
    kTdmsNew = 4,
    kTdmsRaw = 8,
    kTdmsInterleaved = 32,
    kTdmsBig = 64,
    kTdmsDaqmx = 128
};

// Writes TDMS segments in one byte order.
class TdmsBytes {
  public:
    explicit TdmsBytes(bool big = false) : big_(big) {}

    std::string number(std::uint64_t value, int width) const {
        std::string bytes;
        append_number(bytes, value, width, big_);
        return bytes;
    }
    std::string real(double value) const { return number(std::bit_cast<std::uint64_t>(value), 8); }
    std::string reals(const std::vector<double>& values) const {
        std::string bytes;
        for (const double value : values) {
            bytes += real(value);
        }
        return bytes;
    }
    std::string text(const std::string& value) const { return number(value.size(), 4) + value; }

    std::string property(const std::string& name, const std::string& value) const {
        return text(name) + number(0x20, 4) + text(value);
    }
    std::string property(const std::string& name, const char* value) const {
        return property(name, std::string(value));
    }
    std::string property(const std::string& name, double value) const {
        return text(name) + number(10, 4) + real(value);
    }
    std::string property(const std::string& name, std::uint32_t value) const {
        return text(name) + number(7, 4) + number(value, 4);
    }

    // Index of raw data of a type, for example 10 for doubles.
    std::string index(unsigned type, std::uint64_t count) const {
        return number(20, 4) + number(type, 4) + number(1, 4) + number(count, 8);
    }
    std::string no_index() const { return number(0xFFFFFFFF, 4); }
    std::string same_index() const { return number(0, 4); }

    std::string object(const std::string& path, const std::string& index,
                       const std::vector<std::string>& properties = {}) const {
        std::string bytes = text(path) + index + number(properties.size(), 4);
        for (const std::string& one : properties) {
            bytes += one;
        }
        return bytes;
    }

    std::string segment(unsigned contents, const std::vector<std::string>& objects,
                        const std::string& raw, bool closed = true) const {
        std::string meta;
        if ((contents & kTdmsMeta) != 0) {
            meta = number(objects.size(), 4);
            for (const std::string& one : objects) {
                meta += one;
            }
        }
        std::string bytes = "TDSm";
        append_number(bytes, contents | (big_ ? kTdmsBig : 0U), 4);
        const std::uint64_t length = meta.size() + raw.size();
        return bytes + number(4713, 4) + number(closed ? length : ~std::uint64_t{0}, 8) +
               number(meta.size(), 8) + meta + raw;
    }

  private:
    bool big_;
};

}  // namespace gearpod::test
