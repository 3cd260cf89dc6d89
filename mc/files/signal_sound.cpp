// Reads sound files with libsndfile: WAV, RF64, W64, FLAC, AIFF, AU and CAF without loss.
#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

#include "mc/files/formats/byte_numbers.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

constexpr std::uint64_t kUnknownLength = 0xFFFFFFFF;  // of a recording that was written to a pipe

bool is_known_container(int format) {
    constexpr int kKnown[] = {SF_FORMAT_WAV,  SF_FORMAT_WAVEX, SF_FORMAT_RF64, SF_FORMAT_W64,
                              SF_FORMAT_FLAC, SF_FORMAT_AIFF,  SF_FORMAT_AU,   SF_FORMAT_CAF};
    return std::ranges::find(kKnown, format & SF_FORMAT_TYPEMASK) != std::end(kKnown);
}

bool is_lossless(int format) {
    constexpr int kKnown[] = {SF_FORMAT_PCM_S8,  SF_FORMAT_PCM_U8,  SF_FORMAT_PCM_16,
                              SF_FORMAT_PCM_24,  SF_FORMAT_PCM_32,  SF_FORMAT_FLOAT,
                              SF_FORMAT_DOUBLE,  SF_FORMAT_ALAC_16, SF_FORMAT_ALAC_20,
                              SF_FORMAT_ALAC_24, SF_FORMAT_ALAC_32};
    return std::ranges::find(kKnown, format & SF_FORMAT_SUBMASK) != std::end(kKnown);
}

std::string encoding_name(int format) {
    SF_FORMAT_INFO info{format & SF_FORMAT_SUBMASK, nullptr, nullptr};
    return sf_command(nullptr, SFC_GET_FORMAT_INFO, &info, sizeof info) == 0 && info.name != nullptr
               ? info.name
               : "unknown encoding";
}

// Chunks of a sound file: a name and a length, then the data.
struct ChunkLayout {
    std::uint64_t first, name_width, length_width, alignment;
    bool big_endian, length_includes_head;
    std::string_view samples;  // first bytes of the name of the chunk with the samples
};

// Number of bytes of samples that the header declares but the file lacks; libsndfile would shorten
// the recording without an error. Sources: RIFF, EBU Tech 3306 (RF64), Sony Wave64, AIFF.
std::uint64_t missing_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file.tellg()));
    std::string head(40, '\0');
    const auto read = [&](std::uint64_t at, std::uint64_t count) {
        file.clear();
        file.seekg(static_cast<std::streamoff>(at));
        return static_cast<bool>(file.read(head.data(), static_cast<std::streamsize>(count)));
    };
    if (!read(0, 4)) {
        return 0;
    }
    ChunkLayout layout{12, 4, 4, 2, false, false, "data"};
    if (head.starts_with("FORM")) {
        layout = {12, 4, 4, 2, true, false, "SSND"};
    } else if (head.starts_with("riff")) {
        layout = {40, 16, 8, 8, false, true, "data"};
    } else if (!head.starts_with("RIFF") && !head.starts_with("RF64")) {
        return 0;
    }
    const std::uint64_t head_length = layout.name_width + layout.length_width;
    std::uint64_t length_of_rf64 = kUnknownLength;
    for (std::uint64_t at = layout.first; at < size && size - at >= head_length;) {
        read(at, head_length);
        std::uint64_t length =
            unsigned_at(head, layout.name_width, layout.length_width, layout.big_endian);
        const bool samples = head.starts_with(layout.samples);
        const bool sizes = head.starts_with("ds64");
        if (layout.length_includes_head) {
            length -= std::min(length, head_length);
        }
        at += head_length;
        if (sizes && read(at, 16)) {
            length_of_rf64 = unsigned_at(head, 8, 8);
        }
        if (samples) {
            length = length == kUnknownLength ? length_of_rf64 : length;
            return length == kUnknownLength || length <= size - at ? 0 : length - (size - at);
        }
        if (length > size - at) {
            return length - (size - at);
        }
        at += (length + layout.alignment - 1) / layout.alignment * layout.alignment;
    }
    return 0;
}

class SignalSound : public SignalFile {
  public:
    explicit SignalSound(const std::string& path)
        : path_(path), file_(sf_open(path.c_str(), SFM_READ, &info_), sf_close) {
        if (!file_) {
            const std::string why = sf_strerror(nullptr);
            // Message of libsndfile for a header with a zero.
            refuse(why.find("SF_INFO struct incomplete") == std::string::npos
                       ? "is not a sound file, or is damaged; libsndfile reports: " + why
                       : "is damaged: its header states no valid sampling rate or no channels");
        }
        if (!is_known_container(info_.format)) {
            refuse("is not a WAV, RF64, W64, FLAC, AIFF, AU or CAF file");
        }
        if (!is_lossless(info_.format)) {
            refuse(
                fmt::format("is compressed with loss ({}); save it as plain samples (PCM) or FLAC",
                            encoding_name(info_.format)));
        }
        if (info_.channels <= 0 || info_.frames <= 0) {
            refuse("is a sound file without samples");
        }
        if (const std::uint64_t missing = missing_bytes(path); missing > 0) {
            refuse(fmt::format("is truncated: {} bytes are missing", missing));
        }
    }

    std::vector<std::string> names() const override {
        if (info_.channels == 1) {
            return {"sensor"};
        }
        std::vector<std::string> all;
        for (int c = 1; c <= info_.channels; ++c) {
            all.push_back(fmt::format("channel{}", c));
        }
        return all;
    }

    // Integers are fractions of the full scale.
    std::vector<double> read(const std::string& name) override {
        const auto all = names();
        const auto channel =
            static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
        const auto channels = static_cast<std::size_t>(info_.channels);
        if (sf_seek(file_.get(), 0, SEEK_SET) != 0) {
            refuse("is damaged");
        }
        constexpr sf_count_t kFrames = 4096;
        std::vector<double> values, block(channels * static_cast<std::size_t>(kFrames));
        for (;;) {
            const sf_count_t got = sf_readf_double(file_.get(), block.data(), kFrames);
            for (std::size_t f = 0; f < static_cast<std::size_t>(std::max<sf_count_t>(0, got));
                 ++f) {
                values.push_back(block[f * channels + channel]);
            }
            if (got < kFrames) {
                break;
            }
        }
        if (sf_error(file_.get()) != SF_ERR_NO_ERROR) {
            refuse(fmt::format("is damaged after {} samples; libsndfile reports: {}", values.size(),
                               sf_strerror(file_.get())));
        }
        // Streamed FLAC does not state its length.
        if (info_.frames != SF_COUNT_MAX &&
            values.size() < static_cast<std::size_t>(info_.frames)) {
            refuse(fmt::format("is truncated: only {} of {} samples are present", values.size(),
                               info_.frames));
        }
        return values;
    }
    std::optional<double> sampling_Hz() override { return info_.samplerate; }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw SignalError(path_ + ": " + why);
    }

    std::string path_;
    SF_INFO info_{};
    std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> file_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_sound(const std::string& path) {
    return std::make_unique<SignalSound>(path);
}

}  // namespace gearpod::mc
