#include "lockstep/march.hpp"

namespace gearpod::lockstep {

template <int W>
machine::AlignedVector filter_coefficients(const MarchPlan& plan,
                                           const dynamics::PlanetaryLanes<W>& lanes) {
    const auto& lengths = plan.grid.lengths;
    machine::AlignedVector all(lengths.size() * kFilterCoefficients * W);
    for (std::size_t kind = 0; kind < lengths.size(); ++kind) {
        for (int l = 0; l < W; ++l) {
            double coefficients[kFilterCoefficients];
            filter_step(plan.low_pass_rad_s, lengths[kind] * lanes.mesh_period[l], coefficients);
            for (std::size_t i = 0; i < kFilterCoefficients; ++i) {
                all[(kind * kFilterCoefficients + i) * W + static_cast<std::size_t>(l)] =
                    coefficients[i];
            }
        }
    }
    return all;
}

template machine::AlignedVector filter_coefficients<1>(const MarchPlan&,
                                                       const dynamics::PlanetaryLanes<1>&);
template machine::AlignedVector filter_coefficients<8>(const MarchPlan&,
                                                       const dynamics::PlanetaryLanes<8>&);

MeshRecord make_record(const MarchPlan& plan, int lanes, bool with_motion) {
    const std::size_t rows = plan.samples() * static_cast<std::size_t>(lanes);
    MeshRecord record;
    record.acceleration.resize(rows * static_cast<std::size_t>(plan.channels()));
    record.te.resize(rows);
    if (with_motion) {
        record.motion.resize(rows * static_cast<std::size_t>(plan.layout.degrees_of_freedom()));
    }
    return record;
}

}  // namespace gearpod::lockstep
