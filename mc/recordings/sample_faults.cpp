#include "mc/recordings/sample_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <set>
#include <unordered_map>

#include "machine/upper_median.hpp"

namespace gearpod::mc {
namespace {

constexpr const char* kRemedy = "; use only the part before or after";

std::string constant_stretch(std::span<const double> samples) {
    constexpr std::size_t kLongest = 20, kTimesUsual = 4;
    std::vector<std::size_t> lengths;
    std::size_t longest = 0, first = 0;
    for (std::size_t i = 0; i < samples.size();) {
        std::size_t end = i + 1;
        while (end < samples.size() && samples[end] == samples[i]) {
            ++end;
        }
        lengths.push_back(end - i);
        if (end - i > longest) {
            longest = end - i;
            first = i;
        }
        i = end;
    }
    std::ranges::sort(lengths);
    const std::size_t usual = lengths[(lengths.size() - 1) * 99 / 100];
    if (longest == samples.size() || longest <= kLongest || longest < kTimesUsual * usual) {
        return "";
    }
    const std::size_t last = first + longest;
    return fmt::format("samples {} to {} are all {:.6g}: {}{}", first + 1, last, samples[first],
                       last == samples.size() ? "the recording ends before" : "a dropout",
                       last == samples.size() ? "; cut them off" : kRemedy);
}

std::string copied_block(std::span<const double> samples) {
    constexpr std::size_t kGram = 16, kShortest = 32, kDistinct = 8;
    std::unordered_map<std::uint64_t, std::size_t> seen;
    std::size_t copied = 0, begin = 0, from = 0, longest = 0;
    for (std::size_t i = 0; i + kGram <= samples.size();) {
        std::uint64_t hash = 1469598103934665603ULL;  // FNV-1a over the bits of the samples
        for (std::size_t j = i; j < i + kGram; ++j) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &samples[j], sizeof bits);
            hash = (hash ^ bits) * 1099511628211ULL;
            hash ^= hash >> 29U;
        }
        const auto [entry, added] = seen.try_emplace(hash, i);
        std::size_t length = 0;
        while (!added && i + length < samples.size() &&
               samples[i + length] == samples[entry->second + length]) {
            ++length;
        }
        const auto block = samples.subspan(i, std::max<std::size_t>(length, 1));
        if (length >= kShortest &&
            std::set<double>(block.begin(), block.begin() + kShortest).size() >= kDistinct) {
            if (length > longest) {
                longest = length;
                begin = i;
                from = entry->second;
            }
            copied += length;
            i += length;
        } else {
            ++i;
        }
    }
    return longest > 0 && 2 * copied < samples.size()
               ? fmt::format(
                     "samples {} to {} repeat those from {} on: a block was written twice{}",
                     begin + 1, begin + longest, from + 1, kRemedy)
               : "";
}

}  // namespace

double rms_of(std::span<const double> values) {
    const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

double subtract_mean(std::vector<double>& samples) {
    // From the first sample: a sum of large values would be less accurate.
    double sum = 0.0;
    for (const double value : samples) {
        sum += value - samples.front();
    }
    const double mean = samples.front() + sum / static_cast<double>(samples.size());
    for (double& value : samples) {
        value -= mean;
    }
    return mean;
}

std::string stretches_text(std::span<const double> samples) {
    const std::string constant = constant_stretch(samples);
    return constant.empty() ? copied_block(samples) : constant;
}

std::string spikes_text(std::span<const double> samples) {
    constexpr double kFar = 30.0, kNeighbour = 0.25, kNormal = 1.4826;
    std::vector<double> sizes;
    for (const double value : samples) {
        sizes.push_back(std::abs(value));
    }
    const double limit = kFar * kNormal * machine::upper_median(sizes);
    std::string places;
    std::size_t count = 0;
    for (std::size_t i = 2; limit > 0.0 && i + 2 < sizes.size(); ++i) {
        const bool pair = sizes[i + 1] > limit;
        if (sizes[i] > limit && sizes[i - 1] < kNeighbour * limit &&
            sizes[i + (pair ? 2 : 1)] < kNeighbour * limit) {
            constexpr std::size_t kShown = 5;
            places += ++count > kShown ? "" : fmt::format("{}{}", count > 1 ? ", " : "", i + 1);
        }
    }
    return count == 0 ? ""
                      : fmt::format(
                            "{} isolated spike(s) far outside the signal (sample {}{}): "
                            "transmission errors? The features contain them",
                            count, places, count > 5 ? ", ..." : "");
}

std::string level_step_text(std::span<const double> samples) {
    constexpr std::size_t kParts = 32, kFewest = 4;
    constexpr double kOfRms = 0.5, kOfScatter = 8.0;
    const std::size_t length = samples.size() / kParts;
    if (length < 64) {
        return "";
    }
    std::vector<double> means;
    for (std::size_t part = 0; part < kParts; ++part) {
        double sum = 0.0;
        for (const double value : samples.subspan(part * length, length)) {
            sum += value / static_cast<double>(length);
        }
        means.push_back(sum);
    }
    const auto around = [&](std::size_t begin, std::size_t end) {
        std::vector<double> side(means.begin() + static_cast<std::ptrdiff_t>(begin),
                                 means.begin() + static_cast<std::ptrdiff_t>(end));
        const double mean = subtract_mean(side);
        return std::pair{mean, rms_of(side)};
    };
    const double rms = rms_of(samples);
    for (std::size_t part = kFewest; part + kFewest <= kParts; ++part) {
        // The part with the step itself belongs to neither side.
        const auto [before, scatter] = around(0, part - 1);
        const auto [after, later] = around(part, kParts);
        const double step = std::abs(after - before);
        if (step > kOfRms * rms && step > kOfScatter * std::max(scatter, later)) {
            return fmt::format(
                "its mean steps by {:.4g} m/s^2 between samples {} and {}: a change "
                "of the recorder? The features contain it",
                after - before, (part - 1) * length + 1, part * length);
        }
    }
    return "";
}

}  // namespace gearpod::mc
