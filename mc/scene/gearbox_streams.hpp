// Which gearbox and which record of it, and the random numbers that these have for a purpose.
#pragma once

#include <boost/random/normal_distribution.hpp>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

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
    std::uint64_t repeat = 0;  // of the judged record, with other noise
    NoiseDraws draws = NoiseDraws::plain;
    // Other gearboxes of the group, by index, whose draws have taken the place of some of its own
    // in this order (analysis/detection/splitting.hpp): of each 3, 10 or 30 % by its index, drawn
    // by itself. Elsewhere none. The maker's memory.
    std::span<const std::uint64_t> exchanged = {};
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

// Standard normal numbers for a purpose that belong to the gearbox, each exchanged by itself.
class Normals {
  public:
    Normals(const Study& study, const GearboxId& id, std::string_view purpose);
    double operator()();

  private:
    struct Exchange {
        double share;  // of the numbers
        Philox taken, engine;
    };
    Philox engine_;
    std::vector<Exchange> exchanges_;
    boost::random::normal_distribution<double> unit_;
};

}  // namespace gearpod::mc
