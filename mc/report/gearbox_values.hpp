// Contact loss ratio (fraction of time out of contact) of each mesh, over the gearboxes of an
// ensemble.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "machine/fields.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Contact loss ratio of one mesh, over the gearboxes that did not fail.
struct ContactLossSummary {
    std::string mesh;
    double mean = 0.0;
    double lower = 0.0, median = 0.0, upper = 0.0;  // quantiles 0.05, 0.5 and 0.95
    std::size_t rows = 0;
};
GEARPOD_FIELDS(ContactLossSummary, mesh, mean, lower, median, upper, gearboxes)

// Returns one entry for each mesh that has a value in some row; none where teeth cannot separate.
std::vector<ContactLossSummary> summarise_contact_loss(const Results& frame, const RowSource& rows);

// Lists means and the central 90 % range over the gearboxes, for example
// "sun-planet 4.2 % (1.1 % to 9.3 %), ring-planet ...". "" without meshes.
std::string contact_loss_text(const std::vector<ContactLossSummary>& meshes);

// Section of a report; empty without meshes.
analysis::Section contact_section(const std::vector<ContactLossSummary>& meshes);

// Table of feature values for each gearbox. It replaces the detection rates if a study has too few
// healthy gearboxes for any threshold, such as the studies of published figures.

// Returns the values of the test rows at every noise level, with the inputs that differ between
// the rows. Empty if a feature has a threshold, or if there are more than 60 rows.
// `frame.detection` must be up to date (detect_all).
analysis::Section feature_values(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
