#include "mc/report/row_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <sstream>

#include "mc/random/philox.hpp"
#include "mc/scene/gearbox_streams.hpp"

namespace gearpod::mc {
namespace {

std::size_t split_of(Philox engine) {
    constexpr double kFirstShare = 0.7, kSecondShare = 0.15;
    const double variate = boost::random::uniform_01<double>()(engine);
    return variate < kFirstShare ? 0 : variate < kFirstShare + kSecondShare ? 1 : 2;
}

}  // namespace

RowIdentities::RowIdentities(const Results& frame, const std::optional<Study>& study) {
    if (study) {
        study_ = *study;
        seed_ = static_cast<std::uint64_t>(study_.ensemble.seed);
        plan_.emplace(study_.ensemble, read_part(frame.provenance_value("part")).value_or(Part{}));
    }
    std::istringstream names(frame.provenance_value("recorded_gearboxes"));
    for (std::string name; std::getline(names, name);) {
        recorded_.push_back(name);
    }
}

RowIdentity RowIdentities::of(std::size_t row) const {
    return plan_ ? of_simulated(row) : of_recorded(row);
}

RowIdentity RowIdentities::of_simulated(std::size_t row) const {
    const Batch batch = plan_->batch(plan_->batch_of_row(row));
    const std::size_t within = row - batch.first_row, record = within % batch.records;
    const GearboxId id{batch.group, batch.first_index + within / batch.records, Record::test,
                       record};
    return {fmt::format("{}-{}", id.group == Group::threshold ? "threshold" : "graded", id.index),
            static_cast<std::size_t>(row_of_id(study_, id)), record,
            split_of({seed_, id.group, id.index, StreamPurpose::dataset_split})};
}

// The seed is 0, so that a gearbox has the same split in every results file.
RowIdentity RowIdentities::of_recorded(std::size_t row) const {
    const bool named = row < recorded_.size() && !recorded_[row].empty();
    const std::string name = named ? recorded_[row] : fmt::format("recording-{}", row);
    const auto end = recorded_.begin() + static_cast<std::ptrdiff_t>(named ? row : 0);
    return {name, row, static_cast<std::size_t>(std::count(recorded_.begin(), end, name)),
            split_of({seed_, Group::threshold, 0,
                      with_suffix(StreamPurpose::dataset_split, "." + name)})};
}

}  // namespace gearpod::mc
