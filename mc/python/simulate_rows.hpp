// Simulates gearboxes of a study in parallel, for Python.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "mc/gearbox/simulation.hpp"

namespace gearpod::python {

// Failure of a gearbox; the message names its row.
class GearboxFailed : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Simulates the gearboxes in these rows of the results. All columns and features have the values of
// the first row, then those of the second, and so on. `interrupted` is polled by the calling thread
// between gearboxes; if it returns true, the result is empty. Throws BadInput for rows that do not
// exist and GearboxFailed. The values do not depend on the number of threads.
mc::Simulation simulate_rows(const mc::Scene& scene, const std::vector<long>& rows, long meshes,
                             const std::function<bool()>& interrupted);

}  // namespace gearpod::python
