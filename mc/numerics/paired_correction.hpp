// Correction of a run's features for the error of its steps (two-level Monte Carlo: M. B. Giles,
// Acta Numerica 24 (2015), 259-328): some gearboxes are computed twice, with the run's steps and
// with fine ones, and all are corrected by the fitted difference.
//
// Only a difference that grows with the fault changes detection. One that all gearboxes have in
// common moves the threshold as well.
#pragma once

#include <span>
#include <vector>

#include "analysis/reliability.hpp"
#include "machine/fields.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Standard deviation of a sample; NaN for fewer than two values.
double standard_deviation(const std::vector<double>& values);

// Values of one feature of gearboxes computed twice, with their fault sizes (0: healthy).
struct PairedValues {
    std::vector<double> own, fine, size;
};

// Least squares fit of the difference; pairs without a value are left out. NaN for fewer than
// eight healthy or eight faulty pairs.
PairedCorrection fit_correction(const PairedValues& pairs);

// a90 and detection rates of one feature at one noise level from corrected values.
struct CorrectedDetection {
    double pd_change = 0.0;  // largest change of a detection rate, over all sizes
    // a90, and its values at the ends of the 95 % interval of the correction alone; NaN if not
    // reached.
    double a90 = 0.0, a90_lower = 0.0, a90_upper = 0.0;
};
GEARPOD_FIELDS(CorrectedDetection, pd_change, a90, a90_lower, a90_upper)

// By feature and noise level; empty if the frame has no corrections.
std::vector<CorrectedDetection> corrected_detection(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
