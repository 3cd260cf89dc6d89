// Names in the results file, common to its writer and its reader.
#pragma once

#include "mc/files/hdf5_data.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

inline constexpr const char* kResultsFormat = "gearpod results";
inline constexpr const char* kStatusMeanings =
    "0 ok, 1 diverged, 2 not converged, 3 unstable above a critical speed of the carrier, 4 "
    "unstable by parametric resonance, 5 step too long, 6 no equilibrium";
inline constexpr const char* kContactLoss = "contact_loss";
inline constexpr const char* kIntegration = "integration";
inline constexpr const char* kSuperposedMeaning =
    "1: the motion was superposed from the effects of the gears' errors; 0: all mesh periods were "
    "integrated";
inline constexpr const char* kVariants = "variants";
inline constexpr const char* kContactLossMeaning =
    "contact loss ratio: the share of its engagement, within the nominal path of contact, in which "
    "a "
    "tooth pair carries no load, averaged over the tooth pairs of the mesh";
inline constexpr const char* kGroupMeanings = "0 threshold sample, 1 test gearboxes, 2 neither";

// Name of the dataset with the values that belong to the columns of a feature.
inline const char* columns_name(const Results& frame) {
    return frame.provenance_value("kind") == kLivesKind ? "hours" : "noise_levels";
}

// Column of Results, the dataset that holds it, and its index among the numbers of a row
// (RowShape).
template <class Values, class Object>
struct StoredColumn {
    std::string dataset;       // "features/rms"
    std::size_t first, width;  // in a row
    bool by_level;             // if the dataset has the shape rows x levels
    Values& values;
    Object& object;  // that has the values
};
template <class Values, class Object>
StoredColumn(std::string, std::size_t, std::size_t, bool, Values&, Object&)
    -> StoredColumn<Values, Object>;

// Calls `use` with all columns of Results, in the order of their numbers in a row.
template <class Frame, class Use>
void for_each_column(Frame& frame, const Use& use) {
    std::size_t first = 0;
    const auto use_all = [&](const std::string& group, auto& columns, bool by_level) {
        const std::size_t width = by_level ? frame.noise_levels.size() : 1;
        for (auto& column : columns) {
            use(StoredColumn{group + "/" + column.name, first, width, by_level, column.values,
                             column});
            first += width;
        }
    };
    use_all("instances", frame.parameters, false);
    use_all("features", frame.features, true);
    use_all(kContactLoss, frame.contact_loss, false);
    use_all(kIntegration, frame.integration, false);
    for (auto& variant : frame.variants) {
        use_all(std::string(kVariants) + "/" + variant.name, variant.features, true);
    }
}

// Member of a struct, and the name of its dataset or attribute.
template <class Of, class Value>
struct NamedMember {
    const char* name;
    Value Of::*member;
};

// Numbers of one cell and of one level by dataset name: long and double members of each.
inline constexpr NamedMember<analysis::DetectionCell, long> kCellCounts[] = {
    {"detected", &analysis::DetectionCell::detected},
    {"tested", &analysis::DetectionCell::tested},
    {"failed", &analysis::DetectionCell::failed}};
inline constexpr NamedMember<analysis::DetectionCell, double> kCellNumbers[] = {
    {"pd", &analysis::DetectionCell::pd},
    {"lower", &analysis::DetectionCell::lower},
    {"upper", &analysis::DetectionCell::upper}};

inline constexpr NamedMember<analysis::LevelDetection, long> kLevelCounts[] = {
    {"threshold_sample", &analysis::LevelDetection::threshold_sample},
    {"threshold_alarms", &analysis::LevelDetection::threshold_alarms}};
inline constexpr NamedMember<analysis::LevelDetection, double> kLevelNumbers[] = {
    {"noise_level", &analysis::LevelDetection::noise_level},
    {"threshold", &analysis::LevelDetection::threshold}};

// Explains the status of a gearbox in words.

// Predicate of a sentence about a gearbox with this status, for example "is unstable ...".
const char* failure_text(Status status);

// Groups /numerical and /step_error of a results file: errors of the time steps.

// Writes the groups that the frame has.
void write_numerical_groups(hid_t root, const Results& frame);

// Reads the groups that the file has; features and noise levels must have been read. `most`:
// largest number of values of a dataset. Throws Hdf5Error with the name of a damaged dataset.
void read_numerical_groups(hid_t root, std::size_t most, Results& results);

}  // namespace gearpod::mc
