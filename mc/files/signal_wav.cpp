// Reads WAV files (RIFF): integers of 8, 16, 24 and 32 bits, and floating-point numbers of 32 and
// 64 bits.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

constexpr std::uint16_t kWhole = 1, kFloating = 3, kExtensible = 0xFFFE;

// Little-endian number, independent of the machine's byte order.
std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    }
    return value;
}

class SignalWav : public SignalFile {
  public:
    explicit SignalWav(const std::string& path) : path_(path) {
        std::ifstream stream(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(stream), {});
        if (bytes_.size() < 12 || bytes_.compare(0, 4, "RIFF") != 0 ||
            bytes_.compare(8, 4, "WAVE") != 0) {
            refuse("is not a WAV file, or is damaged");
        }
        for (std::size_t at = 12; at + 8 <= bytes_.size();) {
            const std::string kind = bytes_.substr(at, 4);
            const std::size_t size = number_at(bytes_, at + 4, 4);
            at += 8;
            if (kind == "fmt ") {
                read_format(at, size);
            } else if (kind == "data") {
                first_ = at;
                // An interrupted recorder leaves a length larger than the file.
                length_ = std::min(size, bytes_.size() - at);
            }
            at += size + size % 2;
        }
        if (channels_ == 0 || length_ == 0) {
            refuse("is a WAV file without samples, or is damaged");
        }
    }

    std::vector<std::string> names() const override {
        if (channels_ == 1) {
            return {"sensor"};
        }
        std::vector<std::string> all;
        for (std::size_t c = 1; c <= channels_; ++c) {
            all.push_back(fmt::format("channel{}", c));
        }
        return all;
    }
    std::vector<double> read(const std::string& name) override {
        const auto all = names();
        std::size_t channel = 0;
        while (all[channel] != name) {
            ++channel;
        }
        const std::size_t width = bits_ / 8, frame = width * channels_;
        std::vector<double> values;
        for (std::size_t at = channel * width; at + width <= length_; at += frame) {
            values.push_back(sample(number_at(bytes_, first_ + at, width)));
        }
        return values;
    }
    std::optional<double> sampling_Hz() override { return rate_; }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw SignalError(path_ + ": " + why);
    }
    void read_format(std::size_t at, std::size_t size) {
        if (size < 16 || at + size > bytes_.size()) {
            refuse("is a damaged WAV file");
        }
        kind_ = number_at(bytes_, at, 2);
        if (kind_ == kExtensible && size >= 26) {
            kind_ = number_at(bytes_, at + 24, 2);
        }
        channels_ = number_at(bytes_, at + 2, 2);
        rate_ = static_cast<double>(number_at(bytes_, at + 4, 4));
        bits_ = number_at(bytes_, at + 14, 2);
        const bool whole =
            kind_ == kWhole && (bits_ == 8 || bits_ == 16 || bits_ == 24 || bits_ == 32);
        if (!whole && !(kind_ == kFloating && (bits_ == 32 || bits_ == 64))) {
            refuse(
                fmt::format("is a compressed WAV file (format {}, {} bits); save it as plain "
                            "samples (PCM)",
                            kind_, bits_));
        }
    }
    // Value of a sample; integers are scaled to full scale 1.
    double sample(std::uint64_t raw) const {
        if (kind_ == kFloating) {
            return bits_ == 64 ? std::bit_cast<double>(raw)
                               : std::bit_cast<float>(static_cast<std::uint32_t>(raw));
        }
        if (bits_ == 8) {
            return (static_cast<double>(raw) - 128.0) / 128.0;
        }
        const double full = static_cast<double>(std::uint64_t{1} << (bits_ - 1));
        const auto value = static_cast<double>(raw);
        return (value >= full ? value - 2.0 * full : value) / full;
    }

    std::string path_, bytes_;
    std::size_t first_ = 0, length_ = 0, channels_ = 0, bits_ = 0;
    std::uint64_t kind_ = 0;
    double rate_ = 0.0;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_wav(const std::string& path) {
    return std::make_unique<SignalWav>(path);
}

}  // namespace gearpod::mc
