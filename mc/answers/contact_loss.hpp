// Share of time out of contact over the gearboxes of an ensemble, mesh by mesh.
#pragma once

#include <string>
#include <vector>

#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// The contact loss ratio of one mesh over the gearboxes that worked.
struct ContactLossSummary {
    std::string mesh;
    double mean = 0.0;
    double lower = 0.0, median = 0.0, upper = 0.0;  // quantiles 0.05, 0.5 and 0.95
    std::size_t rows = 0;
};

// One entry a mesh that has a value in some row; none where teeth cannot part.
std::vector<ContactLossSummary> summarise_contact_loss(const Results& frame, const RowSource& rows);

// "sun-planet 4.2 % (1.1 % to 9.3 %), ring-planet ...": means and the range of the middle 90 % of
// the gearboxes; "" without meshes.
std::string contact_loss_text(const std::vector<ContactLossSummary>& meshes);

}  // namespace gearpod::mc
