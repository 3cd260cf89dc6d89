// Groups /numerical and /step_error of a results file: errors of the time steps.
#pragma once

#include "mc/files/hdf5_data.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Attributes of /step_error: first the double members, then the int members.
inline constexpr NamedMember<StepError, double> kStepErrorNumbers[] = {
    {"sensor", &StepError::sensor}, {"te", &StepError::te}};
inline constexpr NamedMember<StepError, int> kStepErrorCounts[] = {
    {"steps", &StepError::steps},
    {"finer_steps", &StepError::finer_steps},
    {"gearboxes", &StepError::gearboxes},
    {"meshes", &StepError::meshes}};

// Writes the groups that the frame has.
void write_numerical_groups(hid_t root, const Results& frame);

// Reads the groups that the file has; features and noise levels must have been read. `most`:
// largest number of values of a dataset. Throws Hdf5Error with the name of a damaged dataset.
void read_numerical_groups(hid_t root, std::size_t most, Results& results);

}  // namespace gearpod::mc
