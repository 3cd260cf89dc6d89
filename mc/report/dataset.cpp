#include "mc/report/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "mc/plan/gearbox_streams.hpp"
#include "mc/results/provenance.hpp"
#include "mc/study/random/philox.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

std::size_t split_of(Philox engine) {
    constexpr double kFirstShare = 0.7, kSecondShare = 0.15;
    const double variate = boost::random::uniform_01<double>()(engine);
    return variate < kFirstShare ? 0 : variate < kFirstShare + kSecondShare ? 1 : 2;
}

// Meaning of a column of /instances.
std::string input_meaning(const std::string& name) {
    if (name == kNoiseWeight) {
        return "importance weight of the record for features of the accelerometer";
    }
    for (const Key& key : schema()) {
        if (key.may_be_random() && key.column() == name) {
            return fmt::format("{}: {}", key.path(), key.doc);
        }
    }
    return "column of the recordings' list";
}

}  // namespace

RowIdentities::RowIdentities(const Results& frame, const std::optional<RunFacts>& facts) {
    if (facts) {
        seed_ = static_cast<std::uint64_t>(facts->ensemble.seed);
        order_ = facts->rows;
        plan_.emplace(
            facts->ensemble.batches(read_part(frame.provenance_value("part")).value_or(Part{})));
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
            static_cast<std::size_t>(order_->row_of(id)), record,
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

nlohmann::json dataset_json(const Results& frame, std::size_t rows, const std::string& file) {
    const bool recorded = frame.provenance_value("kind") == kRecordingsKind;
    const auto facts = recorded ? std::nullopt : run_facts(frame.provenance_value("study"), file);
    if (!facts && !recorded) {
        throw std::runtime_error(file +
                                 ": its study cannot be read by this version; "
                                 "--dataset needs it for the gearboxes' identities");
    }
    nlohmann::json json{{"file", std::filesystem::absolute(file).string()},
                        {"recorded", recorded},
                        {"computed_by", version_text(frame.provenance_value("code_version"),
                                                     frame.provenance_value("git_hash"))},
                        {"written_by", version_text()},
                        {"inputs", nlohmann::json::array()},
                        {"rows", nlohmann::json::array()}};
    for (const ParameterResult& input : frame.parameters) {
        json["inputs"].push_back(
            {{"name", input.name}, {"unit", input.unit}, {"meaning", input_meaning(input.name)}});
    }
    const RowIdentities identities(frame, facts);
    for (std::size_t row = 0; row < rows; ++row) {
        const RowIdentity identity = identities.of(row);
        json["rows"].push_back(
            {identity.row, identity.gearbox, identity.record, kSplitNames[identity.split]});
    }
    return json;
}

}  // namespace gearpod::mc
