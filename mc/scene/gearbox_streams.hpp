// Which gearbox and which record of it, and the random numbers that these have for a purpose.
#pragma once

#include <boost/random/normal_distribution.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/detection/draw_exchange.hpp"
#include "mc/random/philox.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Of a gearbox: the one that is judged, and the one from before its fault that it is compared with.
enum class Record { judged, baseline };

// How a record's noise is drawn: as it is, or as one of several kinds in turn, most of them tilted
// (signals/windowing/noise_tilt.hpp).
enum class NoiseDraws { plain, towards_alarms, towards_misses };

// Which gearbox: row `index` of its group; and which record of it.
struct GearboxId {
    Group group = Group::graded;
    std::uint64_t index = 0;
    Record record = Record::judged;
    std::uint64_t repeat = 0;  // of the record, with other noise
    NoiseDraws draws = NoiseDraws::plain;
    // Of gearboxes that are split (analysis/detection/splitting.hpp): what it has exchanged with
    // others of the group, in this order; perhaps nothing yet. The maker's memory. All random
    // inputs that have a quantile are made of normal numbers then.
    std::optional<std::span<const analysis::DrawExchange>> exchanged = {};
};

// Whose random numbers for a purpose the gearbox has, where all of them are exchanged as one: its
// own index, or that of the last of `exchanged` that they were taken from.
std::uint64_t drawn_from(const Study& study, const GearboxId& id, std::string_view purpose);

// The random numbers for a purpose that belong to the gearbox, the same in all its records.
Philox gearbox_stream(const Study& study, const GearboxId& id, std::string_view purpose);
// Those that every record has of its own.
Philox record_stream(const Study& study, const GearboxId& id, std::string_view purpose);
// Those of its noise: every repeat has its own, the first that of the record.
Philox noise_stream(const Study& study, const GearboxId& id, std::string_view purpose);

// Standard normal numbers for a purpose, each exchanged by itself. Of an object either one by one
// or many at once.
class Normals {
  public:
    // That belong to the gearbox, as gearbox_stream().
    Normals(const Study& study, const GearboxId& id, std::string_view purpose);
    // Of a record and of its noise, as record_stream() and noise_stream().
    static Normals of_record(const Study& study, const GearboxId& id, std::string_view purpose);
    static Normals of_noise(const Study& study, const GearboxId& id, std::string_view purpose);

    double operator()();
    void normals(std::span<double> values);  // signals::draw_normals()

  private:
    struct Exchange {
        double own, other;  // factors
        Philox engine;
    };
    Philox engine_;
    std::vector<Exchange> exchanges_;
    boost::random::normal_distribution<double> unit_;
    std::vector<double> others_;
};

}  // namespace gearpod::mc
