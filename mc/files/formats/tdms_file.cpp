#include "mc/files/formats/tdms_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <unordered_map>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/files/formats/signal_error.hpp"

namespace gearpod::mc {

double TdmsTime::since(const TdmsTime& earlier) const {
    const double whole = static_cast<double>(seconds) - static_cast<double>(earlier.seconds);
    const double parts = fraction >= earlier.fraction
                             ? static_cast<double>(fraction - earlier.fraction)
                             : -static_cast<double>(earlier.fraction - fraction);
    return whole + std::ldexp(parts, -64);
}

std::uint64_t tdms_width(TdmsType type) {
    switch (type) {
        case TdmsType::int8:
        case TdmsType::uint8:
        case TdmsType::boolean:
            return 1;
        case TdmsType::int16:
        case TdmsType::uint16:
            return 2;
        case TdmsType::int32:
        case TdmsType::uint32:
        case TdmsType::float32:
        case TdmsType::float32_with_unit:
            return 4;
        case TdmsType::int64:
        case TdmsType::uint64:
        case TdmsType::float64:
        case TdmsType::float64_with_unit:
        case TdmsType::complex64:
            return 8;
        case TdmsType::timestamp:
        case TdmsType::complex128:
            return 16;
        case TdmsType::none:
        case TdmsType::string:
            break;
    }
    return 0;
}

double tdms_number(std::string_view bytes, std::size_t at, TdmsType type, bool big_endian) {
    const std::size_t width = tdms_width(type);
    switch (type) {
        case TdmsType::float32:
        case TdmsType::float64:
        case TdmsType::float32_with_unit:
        case TdmsType::float64_with_unit:
            return ieee_at(bytes, at, width, big_endian);
        case TdmsType::int8:
        case TdmsType::int16:
        case TdmsType::int32:
        case TdmsType::int64:
            return static_cast<double>(signed_at(bytes, at, width, big_endian));
        case TdmsType::uint8:
        case TdmsType::uint16:
        case TdmsType::uint32:
        case TdmsType::uint64:
        case TdmsType::boolean:
        case TdmsType::none:
        case TdmsType::string:
        case TdmsType::timestamp:
        case TdmsType::complex64:
        case TdmsType::complex128:
            break;
    }
    return static_cast<double>(unsigned_at(bytes, at, width, big_endian));
}

TdmsTime tdms_time(std::string_view bytes, std::size_t at, bool big_endian) {
    const std::uint64_t first = unsigned_at(bytes, at, 8, big_endian);
    const std::uint64_t second = unsigned_at(bytes, at + 8, 8, big_endian);
    return big_endian ? TdmsTime{static_cast<std::int64_t>(first), second}
                      : TdmsTime{static_cast<std::int64_t>(second), first};
}

bool is_tdms_number(TdmsType type) {
    return tdms_width(type) > 0 && type != TdmsType::timestamp && type != TdmsType::complex64 &&
           type != TdmsType::complex128;
}

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

namespace {

constexpr std::uint64_t kLeadIn = 28;
constexpr std::uint64_t kNotClosed = ~std::uint64_t{0};
// Bits of the table of contents in the lead-in of a segment.
constexpr std::uint64_t kMetaData = 1 << 1, kNewObjects = 1 << 2, kRawData = 1 << 3,
                        kInterleaved = 1 << 5, kBigEndian = 1 << 6;
class TdmsReader {
  public:
    explicit TdmsReader(const std::string& path)
        : path_(path), stream_(path, std::ios::binary | std::ios::ate) {
        size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, stream_.tellg()));
    }

    TdmsFile read() {
        for (std::uint64_t at = 0; at < size_;) {
            try {
                at = read_segment(at);
            } catch (const TdmsDamage& damage) {
                throw SignalError(fmt::format("{}: {} segment at byte {}: {}", path_,
                                              damage.unsupported ? "cannot be read because of the"
                                                                 : "is damaged or truncated in the",
                                              at, damage.why));
            }
        }
        if (size_ == 0) {
            throw SignalError(path_ + ": is empty");
        }
        return std::move(file_);
    }

  private:
    std::string bytes(std::uint64_t at, std::uint64_t count) {
        if (at > size_ || count > size_ - at) {
            throw TdmsDamage{"it ends too early"};
        }
        std::string read(count, '\0');
        stream_.seekg(static_cast<std::streamoff>(at));
        if (!stream_.read(read.data(), static_cast<std::streamsize>(count))) {
            throw TdmsDamage{"it cannot be read"};
        }
        return read;
    }

    // Returns the position of the next segment.
    std::uint64_t read_segment(std::uint64_t at) {
        const std::string lead_in = bytes(at, kLeadIn);
        if (!lead_in.starts_with("TDSm")) {
            throw TdmsDamage{"it does not begin with TDSm"};
        }
        const std::uint64_t contents = unsigned_at(lead_in, 4, 4);  // always little-endian
        big_endian_ = (contents & kBigEndian) != 0;
        std::uint64_t next = unsigned_at(lead_in, 12, 8, big_endian_);
        const std::uint64_t raw = unsigned_at(lead_in, 20, 8, big_endian_);
        const std::uint64_t rest = size_ - at - kLeadIn;
        // A program that ended while it was recording leaves the last segment without its length.
        closed_ = next != kNotClosed;
        next = closed_ ? next : rest;
        file_.closed = closed_;
        if (next > rest) {
            throw TdmsDamage{fmt::format("it lacks {} bytes", next - rest)};
        }
        if (raw > next) {
            throw TdmsDamage{"its raw data begin after its end"};
        }
        if ((contents & kNewObjects) != 0) {
            active_.clear();
        }
        if ((contents & kMetaData) != 0) {
            read_objects(bytes(at + kLeadIn, raw));
        }
        if ((contents & kRawData) != 0 && next > raw) {
            add_chunks(at + kLeadIn + raw, next - raw, (contents & kInterleaved) != 0);
        }
        return at + kLeadIn + next;
    }

    void read_objects(const std::string& bytes) {
        TdmsCursor cursor(bytes, big_endian_);
        for (std::uint64_t left = cursor.number(4); left > 0; --left) {
            const std::string path = cursor.text();
            const std::vector<std::string> names = tdms_names(path);
            if (names.size() > 2) {
                throw TdmsDamage{"an object has an invalid path"};
            }
            const std::uint64_t length = cursor.number(4);
            TdmsProperties* properties = &file_.properties;
            if (names.size() == 2) {
                const std::size_t channel = channel_of(path, names);
                update_index(cursor, length, channel);
                properties = &file_.channels[channel].properties;
            } else if (length != kTdmsNoData) {
                throw TdmsDamage{"a group has raw data"};
            } else if (names.size() == 1) {
                properties = &file_.groups[names.front()];
            }
            for (std::uint64_t more = cursor.number(4); more > 0; --more) {
                const std::string name = cursor.text();
                (*properties)[name] = cursor.property();
            }
        }
    }

    std::size_t channel_of(const std::string& path, const std::vector<std::string>& names) {
        const auto [found, added] = known_.emplace(path, file_.channels.size());
        if (added) {
            TdmsChannel& channel = file_.channels.emplace_back();
            channel.path = path;
            channel.group = names[0];
            channel.name = names[1];
            indices_.emplace_back();
        }
        return found->second;
    }

    void update_index(TdmsCursor& cursor, std::uint64_t length, std::size_t channel) {
        const auto place = std::ranges::find(active_, channel);
        if (length == kTdmsNoData) {
            if (place != active_.end()) {
                active_.erase(place);
            }
            return;
        }
        std::optional<TdmsIndex>& index = indices_[channel];
        if (length != kTdmsAsBefore) {
            index = read_tdms_index(cursor, length);
        } else if (!index) {
            throw TdmsDamage{"a channel refers to an earlier segment that lacks it"};
        }
        if (place == active_.end()) {
            active_.push_back(channel);
        }
    }

    // Adds the raw data of a segment, which repeat the objects' data in chunks.
    void add_chunks(std::uint64_t at, std::uint64_t length, bool interleaved) {
        const bool daqmx = std::ranges::any_of(
            active_, [&](std::size_t channel) { return indices_[channel]->daqmx; });
        if (daqmx) {
            add_daqmx(at, length);
        } else if (interleaved) {
            add_rows(at, length);
        } else {
            add_columns(at, length);
        }
    }

    // Number of chunks; the last one may be incomplete if the file was not closed.
    std::uint64_t chunks_in(std::uint64_t length, std::uint64_t chunk) const {
        if (chunk == 0 || (closed_ && length % chunk != 0)) {
            throw TdmsDamage{"its raw data are not a whole number of chunks"};
        }
        return length / chunk;
    }
    static std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
        if (b > kNotClosed - a) {
            throw TdmsDamage{"its raw data are larger than possible"};
        }
        return a + b;
    }

    void add_columns(std::uint64_t at, std::uint64_t length) {
        std::uint64_t chunk = 0;
        for (const std::size_t channel : active_) {
            chunk = sum(chunk, indices_[channel]->bytes);
        }
        const std::uint64_t chunks = chunks_in(length, chunk);
        for (std::uint64_t c = 0; c < chunks; ++c) {
            for (const std::size_t channel : active_) {
                const TdmsIndex& index = *indices_[channel];
                add_block(channel, 0, {at, tdms_width(index.type), index.count, index.type});
                at += index.bytes;
            }
        }
    }

    void add_rows(std::uint64_t at, std::uint64_t length) {
        std::uint64_t row = 0, rows = kNotClosed;
        for (const std::size_t channel : active_) {
            const TdmsIndex& index = *indices_[channel];
            if (index.type == TdmsType::string || (rows != kNotClosed && rows != index.count)) {
                throw TdmsDamage{"its interleaved channels have different numbers of values"};
            }
            rows = index.count;
            row += tdms_width(index.type);
        }
        if (row == 0 || length / row < rows) {
            rows = 0;
        }
        // Chunks of rows follow one another, so that all rows are evenly spaced.
        const std::uint64_t count = closed_ ? chunks_in(length, row * rows) * rows
                                            : length / std::max<std::uint64_t>(1, row);
        for (const std::size_t channel : active_) {
            const TdmsIndex& index = *indices_[channel];
            add_block(channel, 0, {at, row, count, index.type});
            at += tdms_width(index.type);
        }
    }

    // DAQmx: a chunk has one buffer after another, and each buffer has rows of its width.
    void add_daqmx(std::uint64_t at, std::uint64_t length) {
        const TdmsIndex& first = *indices_[active_.front()];
        std::uint64_t row = 0;
        std::vector<std::uint64_t> widths_before;
        for (const std::uint64_t width : first.buffer_widths) {
            widths_before.push_back(row);
            row += width;
        }
        for (const std::size_t channel : active_) {
            const TdmsIndex& index = *indices_[channel];
            if (!index.daqmx || index.count != first.count ||
                index.buffer_widths != first.buffer_widths) {
                throw TdmsDamage{"its DAQmx channels have different numbers of values"};
            }
            for (const TdmsScaler& scaler : index.scalers) {
                if (scaler.buffer >= first.buffer_widths.size() ||
                    scaler.offset + tdms_width(scaler.type) > first.buffer_widths[scaler.buffer]) {
                    throw TdmsDamage{"a DAQmx channel lies outside of its buffer"};
                }
            }
        }
        if (row == 0 || first.count == 0 || length / row < first.count) {
            throw TdmsDamage{"its raw data are not a whole number of chunks"};
        }
        const std::uint64_t chunks = chunks_in(length, row * first.count);
        for (std::uint64_t c = 0; c < chunks; ++c) {
            for (const std::size_t channel : active_) {
                file_.channels[channel].daqmx = true;
                for (const TdmsScaler& scaler : indices_[channel]->scalers) {
                    add_block(channel, scaler.scale,
                              {at + widths_before[scaler.buffer] * first.count + scaler.offset,
                               first.buffer_widths[scaler.buffer], first.count, scaler.type});
                }
            }
            at += row * first.count;
        }
    }

    void add_block(std::size_t channel, std::uint32_t scale, TdmsBlock block) {
        if (block.count == 0) {
            return;
        }
        TdmsChannel& to = file_.channels[channel];
        if (to.type != TdmsType::none && to.type != block.type && !to.daqmx) {
            throw TdmsDamage{"a channel changes its type"};
        }
        to.type = block.type;
        block.big_endian = big_endian_;
        auto raw = std::ranges::find(to.raw, scale, &TdmsRaw::scale);
        if (raw == to.raw.end()) {
            raw = to.raw.insert(to.raw.end(), TdmsRaw{scale, {}});
        }
        if (!raw->blocks.empty()) {
            TdmsBlock& last = raw->blocks.back();
            if (last.first + last.count * last.stride == block.first &&
                last.stride == block.stride && last.type == block.type &&
                last.big_endian == block.big_endian) {
                last.count += block.count;
                return;
            }
        }
        raw->blocks.push_back(block);
    }

    std::string path_;
    std::ifstream stream_;
    std::uint64_t size_ = 0;
    bool big_endian_ = false, closed_ = true;
    TdmsFile file_;
    std::unordered_map<std::string, std::size_t> known_;  // indices of channels by path
    std::vector<std::optional<TdmsIndex>> indices_;       // latest of every channel
    std::vector<std::size_t> active_;                     // channels with data in this segment
};

}  // namespace

TdmsFile read_tdms(const std::string& path) {
    return TdmsReader(path).read();
}

}  // namespace gearpod::mc
