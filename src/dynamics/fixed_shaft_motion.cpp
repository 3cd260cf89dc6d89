#include "dynamics/fixed_shaft_motion.hpp"

#include "dynamics/gearbox_matrices.hpp"
#include "machine/contracts.hpp"

namespace gearpod::dynamics {

template <int W, class Real>
FixedShaftLanes<W, Real> make_lanes(const FixedShaftLayout& layout,
                                    std::span<const FixedShaftInputs> inputs) {
    EXPECTS(inputs.size() == W);
    FixedShaftLanes<W, Real> lanes{};
    lanes.sensor = layout.sensor;
    for (int l = 0; l < W; ++l) {
        const FixedShaftInputs& in = inputs[static_cast<std::size_t>(l)];
        const GearboxMatrices m = assemble(layout, in, {0.0});
        for (int i = 0; i < fixed_shaft_motions; ++i) {
            lanes.inverse_mass[i][l] = Real(1.0 / m.mass(i, i));
            lanes.force[i][l] = Real(m.force(i));
        }
        for (const int g : {pinion, gear}) {
            const double r2 = layout.base_radius_m[g] * layout.base_radius_m[g];
            lanes.bearing_stiffness[g][l] = Real(in.bearing_stiffness_N_m[g]);
            lanes.bearing_damping[g][l] = Real(in.bearing_damping_N_s_m[g]);
            lanes.coupling_stiffness[g][l] = Real(in.coupling_stiffness_N_m_rad[g] / r2);
            lanes.coupling_damping[g][l] = Real(in.coupling_damping_N_m_s_rad[g] / r2);
        }
        lanes.mesh_damping.factor[l] = Real(mesh_damping_factor(layout, in, PairId{0}));
        lanes.mesh_period[l] = Real(in.mesh_period_s);
        lanes.backlash[l] = Real(in.backlash_m);
    }
    return lanes;
}

#define GEARPOD_LANES(W, REAL)                                                     \
    template FixedShaftLanes<W, REAL> make_lanes<W, REAL>(const FixedShaftLayout&, \
                                                          std::span<const FixedShaftInputs>);
GEARPOD_FOR_ALL_WIDTHS(GEARPOD_LANES)
#undef GEARPOD_LANES

}  // namespace gearpod::dynamics
