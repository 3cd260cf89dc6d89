// Identifies a gearbox and one of its records, and provides their random numbers for each purpose.
#pragma once

#include <boost/random/normal_distribution.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/splitting.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Records of a gearbox: the test record, and the baseline record from before its fault.
enum class Record { test, baseline };

// Distribution of a record's noise: plain, or cycling through several kinds, most of them
// exponentially tilted (signals/windowing/noise_importance_sampler.hpp).
enum class NoiseSampling { plain, towards_alarms, towards_misses };

// Row `index` of a group of gearboxes, and one record of that gearbox.
struct GearboxId {
    Group group = Group::test;
    std::uint64_t index = 0;
    Record record = Record::test;
    std::uint64_t repeat = 0;  // repetition of the record with other noise
    NoiseSampling noise_sampling = NoiseSampling::plain;
    // Exchanges of random numbers with other gearboxes of the group in multilevel splitting
    // (analysis/detection/splitting.hpp), in order. May be empty; the caller owns the memory. If
    // set, all random inputs that have a quantile are computed from normal variates.
    std::optional<std::span<const analysis::InputExchange>> exchanged = {};
    std::uint64_t baseline = 0;  // number of a baseline record, from 0
    std::uint64_t sensor = 0;    // 0: the first one, else 1 + the number of an additional one
};

// Order of the rows in the results: all records of the threshold gearboxes, one gearbox after the
// other, then the test gearboxes.
struct RowOrder {
    long threshold_gearboxes = 0;
    long records = 1;  // of each threshold gearbox
    // Noise distribution of the threshold gearboxes' records.
    NoiseSampling threshold_noise = NoiseSampling::plain;

    explicit RowOrder(const Ensemble& ensemble);
    long row_of(const GearboxId& id) const;
    GearboxId id_of(long row) const;
};

// Index of the gearbox whose random numbers for a purpose are used, where all of them are exchanged
// together: that of the last exchange in `exchanged` that replaced them, else `id.index`.
std::uint64_t source_index(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);

// Random numbers for a purpose that belong to the gearbox, the same in all its records.
Philox gearbox_stream(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);
Philox record_stream(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);
// Random numbers of a record's noise: different in every repetition; the first repetition uses
// record_stream().
Philox noise_stream(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);

// Standard normal variates for a purpose, each exchanged separately. Use an object either for
// single variates or for blocks, not for both.
class Normals {
  public:
    // Variates of the gearbox, as gearbox_stream().
    Normals(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);
    // Variates of a record and of its noise, as record_stream() and noise_stream().
    static Normals of_record(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);
    static Normals of_noise(std::uint64_t seed, const GearboxId& id, StreamPurpose purpose);

    double operator()();
    void normals(std::span<double> values);  // signals::draw_normals()

  private:
    struct Exchange {
        double factor, other_factor;  // of the variate so far, and of the other gearbox's
        Philox engine;
    };
    Philox engine_;
    std::vector<Exchange> exchanges_;
    boost::random::normal_distribution<double> unit_;
    std::vector<double> others_;
};

}  // namespace gearpod::mc
