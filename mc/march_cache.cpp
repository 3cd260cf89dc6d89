#include "mc/march_cache.hpp"

#include <algorithm>
#include <type_traits>

#include "mc/study_fluctuations.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostBytes = 256'000'000;

static_assert(std::is_trivially_copyable_v<InstanceInputs> &&
                  sizeof(InstanceInputs) % sizeof(double) == 0,
              "the inputs of a gearbox are compared byte by byte");

// All inputs of the march, bit by bit.
std::string key_of(std::span<const InstanceInputs> lanes) {
    std::string key;
    for (InstanceInputs inputs : lanes) {
        inputs.path_exponent = inputs.noise_m_s2 = inputs.encoder_noise_rad = 0.0;
        key.append(reinterpret_cast<const char*>(&inputs), sizeof inputs);
    }
    return key;
}

std::size_t bytes_of(const lockstep::TileResult& result) {
    std::size_t values = 0;
    for (const lockstep::MeshRecord& record : result.records) {
        values += record.acceleration.size() + record.te.size() + record.motion.size();
    }
    return values * sizeof(double);
}

}  // namespace

std::optional<std::size_t> distinct_marches(const Scene& scene) {
    if (scene.load_shares() != nullptr || draws_fluctuations(scene.study())) {
        return std::nullopt;
    }
    std::size_t count = 1;
    for (const RandomInput& input : scene.study().random) {
        if (input.key.starts_with("sensor.")) {
            continue;
        }
        std::vector<double> values = input.distribution.levels();
        if (values.empty()) {
            return std::nullopt;
        }
        if (input.key.starts_with("fault.")) {
            values.push_back(0.0);  // the threshold sample
        }
        std::sort(values.begin(), values.end());
        count *=
            static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
    }
    return count;
}

std::shared_ptr<const lockstep::TileResult> MarchCache::find(
    std::span<const InstanceInputs> lanes) const {
    if (!active_) {
        return nullptr;
    }
    const std::string key = key_of(lanes);
    const std::lock_guard lock(mutex_);
    const auto found = results_.find(key);
    return found == results_.end() ? nullptr : found->second;
}

void MarchCache::keep(std::span<const InstanceInputs> lanes,
                      const lockstep::TileResult& result) const {
    const std::size_t bytes = bytes_of(result);
    if (!active_ || bytes > kMostBytes) {
        return;
    }
    auto copy = std::make_shared<const lockstep::TileResult>(result);
    std::string key = key_of(lanes);
    const std::lock_guard lock(mutex_);
    if (bytes_ + bytes <= kMostBytes && results_.emplace(std::move(key), std::move(copy)).second) {
        bytes_ += bytes;
    }
}

std::size_t MarchCache::kept() const {
    const std::lock_guard lock(mutex_);
    return results_.size();
}

}  // namespace gearpod::mc
