// Counter-based random numbers: Philox4x64-10 (Salmon et al. 2011), from Random123.
// Contract: the words depend on (seed, group, instance, purpose) only. The same instance is the
// same gearbox for any ranks, threads, lanes, order or restart.
#pragma once

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "mc/random/stream_purpose.hpp"

namespace gearpod::mc {

// Two independent samples of a study: healthy gearboxes that set the thresholds, and graded ones to
// which the thresholds are applied.
enum class Group : std::uint64_t { threshold = 0, graded = 1 };

// UniformRandomBitGenerator. Word w of a stream is word w mod 4 of block w / 4. The block is Philox
// at counter (block, instance, purpose, 0) and key (seed, group).
class Philox {
  public:
    using result_type = std::uint64_t;
    using Block = std::array<std::uint64_t, 4>;

    Philox(std::uint64_t seed, Group group, std::uint64_t instance, StreamPurpose purpose)
        : key_{{seed, static_cast<std::uint64_t>(group)}},
          counter_{{0, instance, static_cast<std::uint64_t>(purpose), 0}} {}

    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

    result_type operator()() {
        if (used_ == buffer_.size()) {
            refill();
        }
        return buffer_[used_++];
    }

    // Fills `words` with the next words of the stream.
    void fill(std::span<std::uint64_t> words) {
        std::size_t next = 0;
        while (next < words.size()) {
            if (used_ == buffer_.size() && words.size() - next >= buffer_.size()) {
                const Engine::ctr_type block = Engine{}(counter_, key_);
                ++counter_[0];
                std::copy(block.begin(), block.end(), words.begin() + next);
                next += block.size();
            } else {
                words[next++] = (*this)();
            }
        }
    }

    // Block `number` of the stream, independent of its current position.
    Block block(std::uint64_t number) const {
        Engine::ctr_type counter = counter_;
        counter[0] = number;
        const Engine::ctr_type words = Engine{}(counter, key_);
        Block block{};
        std::copy(words.begin(), words.end(), block.begin());
        return block;
    }

  private:
    using Engine = r123::Philox4x64;

    void refill() {
        buffer_ = Engine{}(counter_, key_);
        ++counter_[0];
        used_ = 0;
    }

    Engine::key_type key_;
    Engine::ctr_type counter_;
    Engine::ctr_type buffer_{};
    std::size_t used_ = 4;
};

}  // namespace gearpod::mc
