#include "mc/ensemble/gearbox/integration_cache.hpp"

#include <algorithm>
#include <set>
#include <type_traits>

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostBytes = 256'000'000;

static_assert(std::is_trivially_copyable_v<InstanceInputs> &&
                  sizeof(InstanceInputs) % sizeof(double) == 0,
              "the inputs of a gearbox are compared byte by byte");

// Bytes of all inputs on which the time integration depends; a key for exact comparison.
std::string key_of(std::span<const Realization> lanes) {
    std::string key;
    for (const Realization& lane : lanes) {
        InstanceInputs inputs = lane.inputs;
        inputs.path_exponent = inputs.gain = inputs.tone_level = inputs.bearing_level =
            inputs.housing_frequency_factor = 0.0;
        inputs.noise_m_s2 = inputs.white_noise_m_s2 = inputs.background_noise_m_s2 =
            inputs.encoder_noise_rad = 0.0;
        key.append(reinterpret_cast<const char*>(&inputs), sizeof inputs);
    }
    return key;
}

std::size_t size_in_bytes(const lockstep::TileResult& result) {
    std::size_t values = 0;
    for (const lockstep::MeshRecord& record : result.records) {
        values += record.acceleration.size() + record.te.size() + record.motion.size();
    }
    return values * sizeof(double);
}

}  // namespace

IntegrationCounts count_integrations(const Sampler& sampler, const SolvePlan& solve,
                                     const BatchPlan& batches, double motion_bytes) {
    // With more distinct gearboxes than this, repetitions are too rare to count.
    constexpr std::size_t kMostDistinct = 2000;
    const auto lanes = static_cast<std::size_t>(solve.settings.numerics.lanes);
    const std::array<std::size_t, 2> rows{batches.threshold_gearboxes(), batches.test_rows()};
    const std::size_t distinct = solve.settings.distinct_integrations.value_or(kMostDistinct + 1);
    IntegrationCounts counts;
    std::set<std::string> keys;
    for (std::size_t g = 0; g < rows.size(); ++g) {
        const std::size_t tiles = (rows[g] + lanes - 1) / lanes;
        counts.integrated[g] = tiles;
        if (distinct > kMostDistinct) {
            continue;
        }
        const std::size_t before = keys.size();
        // n distinct gearboxes in cyclic order fill at most n different tiles; the last tile may be
        // partly filled.
        for (std::size_t t = 0; t < tiles;
             t = t + 1 < distinct ? t + 1 : std::max(t + 1, tiles - 1)) {
            std::vector<Realization> gearboxes;
            for (std::size_t i = t * lanes; i < std::min(rows[g], (t + 1) * lanes); ++i) {
                gearboxes.push_back(sampler.draw({static_cast<Group>(g), i}));
            }
            const Realization last = gearboxes.back();
            gearboxes.resize(lanes, last);
            keys.insert(key_of(gearboxes));
        }
        counts.integrated[g] = keys.size() - before;
    }
    if (distinct > kMostDistinct) {
        return counts;
    }
    const auto room = static_cast<std::size_t>(kMostBytes / std::max(1.0, motion_bytes));
    counts.kept = std::min(room, keys.size());
    // Results that do not fit into the cache are integrated again each time.
    const double lost = 1.0 - static_cast<double>(counts.kept) /
                                  static_cast<double>(std::max<std::size_t>(1, keys.size()));
    for (std::size_t g = 0; g < rows.size(); ++g) {
        const std::size_t tiles = (rows[g] + lanes - 1) / lanes;
        counts.integrated[g] +=
            static_cast<std::size_t>(lost * static_cast<double>(tiles - counts.integrated[g]));
    }
    return counts;
}

std::shared_ptr<const lockstep::TileResult> IntegrationCache::find(
    std::span<const Realization> lanes) const {
    if (!active_) {
        return nullptr;
    }
    const std::string key = key_of(lanes);
    const std::lock_guard lock(mutex_);
    const auto found = results_.find(key);
    return found == results_.end() ? nullptr : found->second;
}

void IntegrationCache::keep(std::span<const Realization> lanes,
                            const lockstep::TileResult& result) const {
    const std::size_t bytes = size_in_bytes(result);
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

std::size_t IntegrationCache::kept() const {
    const std::lock_guard lock(mutex_);
    return results_.size();
}

}  // namespace gearpod::mc
